#include <nlohmann/json.hpp>

#include "anatomy/base/json_text.h"
#include "anatomy/base/whole_file.h"
#include "apps/os/file_access.h"
#include "apps/record/store/deletions.h"

namespace palpa::record {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;
constexpr char kListKind[] = "palpa deletions";
constexpr int kListVersion = 1;

DeletionList listIn(const json& text) {
  DeletionList list{text.at("records"), text.at("salt"), {}, {}};
  for (const json& person : text.at("people"))
    list.people.push_back({person.at("digest"), person.at("deleted_utc")});
  for (const json& session : text.at("sessions"))
    list.sessions.push_back(
        {session.at("uuid"), session.at("deleted_utc"), session.at("evidence_removed")});
  return list;
}

json textOf(const DeletionList& list) {
  json text{{"kind", kListKind}, {"version", kListVersion}, {"records", list.records},
            {"salt", list.salt}, {"people", json::array()}, {"sessions", json::array()}};
  for (const DeletedPerson& person : list.people)
    text["people"].push_back({{"digest", person.digest}, {"deleted_utc", person.deleted_utc}});
  for (const DeletedSession& session : list.sessions)
    text["sessions"].push_back({{"uuid", session.uuid},
                                {"deleted_utc", session.deleted_utc},
                                {"evidence_removed", session.removed}});
  return text;
}

}  // namespace

std::optional<DeletionList> readDeletions(const fs::path& file) {
  const std::optional<std::string> text = readWhole(file);
  if (!text) return std::nullopt;
  try {
    const json parsed = parseJson(*text);
    if (parsed.at("kind") != kListKind || parsed.at("version") != kListVersion) return std::nullopt;
    return listIn(parsed);
  } catch (const json::exception&) {  // no list of ours
    return std::nullopt;
  }
}

void writeDeletions(const DeletionList& list, const fs::path& file) {
  if (const std::error_code problem = os::makeFolders(file.parent_path()))
    failFile("cannot be made", file.parent_path(), problem,
             "Or set XDG_STATE_HOME to another folder");
  writeWhole(file, textOf(list).dump(1) + "\n", Lasts::yes, Readers::owner);
}

}  // namespace palpa::record
