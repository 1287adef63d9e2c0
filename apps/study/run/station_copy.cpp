#include "apps/study/run/station_copy.h"

#include <nlohmann/json.hpp>

#include "anatomy/base/error.h"
#include "anatomy/base/json_text.h"
#include "anatomy/base/sha256.h"
#include "anatomy/base/whole_file.h"
#include "apps/os/file_access.h"
#include "apps/record/store/delivery.h"

namespace palpa::study {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::json;

constexpr std::size_t kDigestLength = 12;  // digits of a digest

}  // namespace

fs::path studyCopyFile(const std::string& study, const std::string& trainee,
                       const std::string& url) {
  return record::PendingList::usualFolder().parent_path() / "studies" /
         (study + "-" + trainee + "-" + sha256(url).substr(0, kDigestLength) + ".json");
}

std::optional<StudyCopy> readStudyCopy(const fs::path& file) {
  const std::optional<std::string> text = readWhole(file);
  if (!text) return std::nullopt;
  try {
    const Json json = parseJson(*text);
    StudyCopy copy;
    copy.protocol_sha256 = json.at("protocol_sha256");
    const Json& e = json.at("enrolment");
    copy.enrolment = {e.at("study"),     e.at("trainee"),   e.at("group"),       e.at("place"),
                      e.at("condition"), e.at("simulated"), e.at("enrolled_utc")};
    for (const Json& t : json.at("trials"))
      copy.trials.push_back(
          {t.at("step"), t.at("session"), t.at("began_utc"), t.at("ended_s"), t.at("outcome")});
    for (const Json& a : json.at("answers"))
      copy.answers.push_back({copy.enrolment.study, copy.enrolment.trainee, a.at("session"),
                              a.at("item"), a.at("questionnaire"), a.at("answer"),
                              a.at("answered_utc")});
    copy.sent = json.at("sent");
    return copy;
  } catch (const Json::exception&) {  // the records know better
    return std::nullopt;
  }
}

void writeStudyCopy(const StudyCopy& copy, const fs::path& file) {
  const record::Enrolment& e = copy.enrolment;
  Json json{{"protocol_sha256", copy.protocol_sha256},
            {"enrolment",
             {{"study", e.study},
              {"trainee", e.trainee},
              {"group", e.group},
              {"place", e.place},
              {"condition", e.condition},
              {"simulated", e.simulated},
              {"enrolled_utc", e.enrolled_utc}}},
            {"trials", Json::array()},
            {"answers", Json::array()},
            {"sent", copy.sent}};
  for (const study::DoneTrial& t : copy.trials)
    json["trials"].push_back({{"step", t.step},
                              {"session", t.session},
                              {"began_utc", t.began_utc},
                              {"ended_s", t.ended_s},
                              {"outcome", t.outcome}});
  for (std::size_t i = 0; i < copy.answers.size(); ++i) {
    const record::ItemAnswer& a = copy.answers[i];
    json["answers"].push_back({{"session", a.session},
                               {"item", a.item},
                               {"questionnaire", a.questionnaire},
                               {"answer", i < copy.sent ? "" : a.answer},
                               {"answered_utc", a.answered_utc}});
  }
  if (const std::error_code problem = os::makeFolders(file.parent_path()))
    failFile("cannot be made", file.parent_path(), problem,
             "Or set XDG_STATE_HOME to another folder");
  writeWhole(file, json.dump(1) + "\n");
}

void removeStudyCopies(const std::string& trainee) {
  std::error_code ignored;
  std::vector<fs::path> theirs;
  for (const auto& entry : fs::directory_iterator(
           record::PendingList::usualFolder().parent_path() / "studies", ignored))
    if (const auto copy = readStudyCopy(entry.path()); copy && copy->enrolment.trainee == trainee)
      theirs.push_back(entry.path());
  for (const fs::path& file : theirs) fs::remove(file, ignored);
}

}  // namespace palpa::study
