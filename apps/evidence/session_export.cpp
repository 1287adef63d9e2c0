#include "apps/evidence/session_export.h"

#include "anatomy/base/whole_file.h"
#include "apps/evidence/recorded_trials.h"

namespace palpa::evidence {
namespace {

std::string dictionaryOf(const record::SessionInfo& info) {
  std::string words;
  for (const record::TickColumn& column : record::tickColumns(info))
    words += column.name + (": " + column.meaning) + '\n';
  return words;
}

}  // namespace

SessionExport exportSession(const record::SessionReader& reader, const std::filesystem::path& csv) {
  const auto beside = [&](const char* ending) {
    return std::filesystem::path(csv).replace_extension(ending);
  };
  SessionExport exported{{csv, beside("columns.txt"), beside("laws.json")}, {}};
  WrittenTogether written;
  record::exportTicks(
      reader,
      [&](const record::VisitTick& visit) {
        exported.check = replayTicks(reader, recordedFloors(reader), visit);
      },
      csv);
  writeWhole(exported.files[1], dictionaryOf(reader.info()));
  writeWhole(exported.files[2], record::lawsJson(reader) + '\n');
  written.keep();
  return exported;
}

}  // namespace palpa::evidence
