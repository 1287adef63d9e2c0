#include "apps/session/output_folder.h"

#include <cerrno>
#include <cstdio>

#include "anatomy/base/counted.h"
#include "anatomy/base/error.h"
#include "anatomy/base/whole_file.h"
#include "apps/os/file_access.h"
#include "apps/record/session_file.h"
#include "apps/record/store/delivery.h"
#include "apps/runtime/clock.h"
#include "apps/session/session_frame.h"

namespace palpa::session {
namespace {

namespace fs = std::filesystem;
constexpr char kInstead[] = "Or choose another folder with --out";

constexpr char kEvidence[] = "session.palpa";

void proveWritable(const fs::path& folder) {
  if (!os::mayWrite(folder)) failFile("cannot be written to", folder, EACCES, kInstead);
  const fs::path probe = folder / ".palpa-write-test";
  writeWhole(probe, "x", Lasts::no);
  std::error_code ignored;
  fs::remove(probe, ignored);
}

/// The session's UUID, where its evidence is there and holds nothing that was felt or done.
std::string emptySession(const fs::path& evidence) {
  const record::SessionReader reader(evidence);
  bool empty = reader.trials().empty();
  if (empty) reader.ticks([&](const haptics::FlightRecord&) { empty = false; });
  return empty ? reader.info().uuid : "";
}

/// False: there is evidence that stays.
bool removedEmpty(const fs::path& evidence) noexcept {
  std::error_code ignored;
  if (!fs::exists(evidence, ignored)) return true;
  try {
    const std::string uuid = emptySession(evidence);
    if (uuid.empty()) return false;
    for (const char* beside : {"", "-wal", "-shm", "-journal"})
      fs::remove(evidence.string() + beside, ignored);
    record::PendingList(record::PendingList::usualFolder()).forget(uuid);
    return true;
  } catch (const std::exception&) {  // whoever reads it says what is wrong
    return false;
  }
}

}  // namespace

fs::path makeOutputFolder(const std::string& given, const std::string& command) {
  fs::path folder =
      given.empty() ? fs::path("out") /
                          (command + "-" + runtime::dateText("%Y%m%d-%H%M%S", runtime::Zone::local))
                    : fs::path(given);
  if (const std::error_code problem = os::makeFolders(folder))
    failFile("cannot be made", folder, problem, kInstead);
  proveWritable(folder);
  return folder;
}

OutputFolder::OutputFolder(const std::string& given, const std::string& command)
    : path_(makeOutputFolder(given, command)), has_older_session_(fs::exists(path_ / kEvidence)) {}

OutputFolder::~OutputFolder() {
  if (!kept_ && !has_older_session_ && !removedEmpty(path_ / kEvidence)) written_.keep();
}

void sayWritten(const SessionRun& run, const std::filesystem::path& folder, const char* report,
                const char* row) {
  std::printf("Written to %s:\n  report.html     %s: open this first\n", folder.c_str(), report);
  std::printf("  trials.csv      one row a %s\n", row);
  std::printf("  session.palpa   the evidence: every tick, for replay\n");
  if (!run.registration.empty())
    std::printf("  registration.csv  how the board was found in each picture\n");
  if (run.video)
    std::printf(
        "  camera.mjpeg    the camera's %llu pictures; camera.mjpeg.csv: when each was exposed, "
        "and where the board was\n",
        static_cast<unsigned long long>(run.video->pictures));
  std::error_code none;
  if (std::filesystem::exists(folder / "room.mjpeg", none))
    std::printf("  room.mjpeg      the room as it was filmed; room.mjpeg.csv: when\n");
  if (!run.pictures.empty())
    std::printf("  view-*.png      %s of the marked moments\n",
                counted(run.pictures.size(), "picture").c_str());
}

}  // namespace palpa::session
