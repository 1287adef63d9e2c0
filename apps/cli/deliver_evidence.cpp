#include "apps/cli/deliver_evidence.h"

#include "apps/cli/evidence_records.h"
#include "apps/record/store/pending.h"

namespace palpa::cli {

std::string absoluteRecords(const std::string& url) {
  return record::isServer(url) || url.find("://") != std::string::npos
             ? url
             : std::filesystem::absolute(url).lexically_normal().string();
}

EvidenceDelivery deliverEvidence(const std::filesystem::path& evidence, const std::string& url,
                                 const record::Patience& patience) {
  const EvidenceRecords records = recordsOf(evidence);
  record::PendingList pending(record::PendingList::usualFolder());
  pending.note({records.session.uuid, evidence, absoluteRecords(url)});
  EvidenceDelivery done{records.session.trainee, {}, records.unfinished};
  try {
    done.trials = record::deliver(url, records.session, records.trials, patience);
  } catch (const record::PersonDeleted&) {
    pending.forget(records.session.uuid);
    throw;
  }
  pending.forget(records.session.uuid);
  return done;
}

}  // namespace palpa::cli
