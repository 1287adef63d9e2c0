#include "apps/cli/evidence_delivery.h"

#include "apps/record/store/pending.h"

namespace palpa::cli {

record::Delivered deliverSession(const std::filesystem::path& evidence,
                                 const EvidenceRecords& records, const std::string& url) {
  record::PendingList pending(record::PendingList::usualFolder());
  pending.note({records.session.uuid, evidence, url});
  record::Delivered delivered;
  try {
    delivered = record::deliver(url, records.session, records.trials);
  } catch (const record::StoreUnreachable&) {
    throw;
  } catch (...) {
    pending.forget(records.session.uuid);
    throw;
  }
  pending.forget(records.session.uuid);
  return delivered;
}

}  // namespace palpa::cli
