#include "apps/session/session_records.h"

#include <cstdio>

#include "anatomy/base/counted.h"
#include "anatomy/base/error.h"
#include "apps/evidence/evidence_records.h"

namespace palpa::session {
namespace {

constexpr char kNobody[] = "T000";
constexpr record::Patience kBriefly{2, 300'000'000};  // a person waits

}  // namespace

void checkTrainee(SessionOptions& o) {
  if (o.records.empty()) return;
  o.records = evidence::absoluteRecords(o.records);
  record::PendingList::usualFolder();  // without one it is said now, not once the session is on
  try {
    record::RecordStore store(o.records);
    if (const auto trainee = store.trainee(o.trainee)) {
      if (trainee->consent_utc.empty())
        std::printf(
            "No consent of %s to training records is noted; where it was given: palpa records "
            "trainee change --id %s --consent\n",
            o.trainee.c_str(), o.trainee.c_str());
      return;
    }
    if (o.trainee != kNobody)
      throw UsageError("is not in the " + store.place(), "trainee " + o.trainee,
                       "Add the trainee first: palpa records trainee add --id " + o.trainee +
                           " --records " + o.records + "; or run without records");
    std::printf(
        "This session is nobody's and will not be in the records: --trainee says whose it is\n");
    o.records.clear();
  } catch (const record::StoreUnreachable& e) {
    std::fprintf(stderr, "palpa: %s\n", e.what());
  }
}

std::unique_ptr<record::PendingHold> noteForRecords(const SessionOptions& o,
                                                    const std::string& uuid,
                                                    const std::filesystem::path& evidence) {
  if (o.records.empty()) return nullptr;
  record::PendingList pending(record::PendingList::usualFolder());
  pending.note({uuid, evidence, o.records});
  return pending.hold(uuid);
}

void deliverSession(const SessionOptions& o, const std::filesystem::path& folder) {
  if (o.records.empty()) return;
  if (!o.quiet) std::fprintf(stderr, "Bringing the trials into the records ...\n");
  try {
    const evidence::EvidenceDelivery done =
        evidence::deliverEvidence(folder / "session.palpa", o.records, kBriefly);
    const auto all = static_cast<std::size_t>(done.trials.added + done.trials.present);
    std::printf("In the records of %s: %s\n", done.trainee.c_str(), counted(all, "trial").c_str());
  } catch (const std::exception& e) {
    const std::string what = e.what();
    std::fprintf(stderr,
                 "palpa: not in the records yet (%s); palpa records deliver sends it later\n",
                 what.substr(0, what.find('\n')).c_str());
  }
}

}  // namespace palpa::session
