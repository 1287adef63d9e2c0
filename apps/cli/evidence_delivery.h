#pragma once

#include <filesystem>
#include <string>

#include "apps/cli/evidence_records.h"
#include "apps/record/store/delivery.h"

namespace palpa::cli {

/// Brings a session's ended trials into the records. Noted as pending until they have all of it, so
/// that what cannot be sent now is sent later. Throws StoreUnreachable then; what time does not
/// mend (a trainee who was deleted) is no longer noted.
record::Delivered deliverSession(const std::filesystem::path& evidence,
                                 const EvidenceRecords& records, const std::string& url);

}  // namespace palpa::cli
