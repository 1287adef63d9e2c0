#pragma once

#include <filesystem>
#include <string>

#include "apps/record/store/delivery.h"

namespace palpa::cli {

struct EvidenceDelivery {
  std::string trainee;
  record::Delivered trials;
  int unfinished = 0;  ///< trials in whose middle the program stopped: left out
};

/// A session's trials into the records at `url`, noted on this station until the store has all of
/// them. What fails stays noted for `palpa records deliver`, but for evidence of a person who was
/// deleted. Throws Error.
EvidenceDelivery deliverEvidence(const std::filesystem::path& evidence, const std::string& url,
                                 const record::Patience& patience = {});

/// Of an address, as it stays true in another folder: files as absolute paths.
std::string absoluteRecords(const std::string& url);

}  // namespace palpa::cli
