#pragma once

#include <filesystem>

#include "apps/os/tls/certificates.h"

namespace palpa::os {

/// An identity in its folder, and the authority that vouches for it.
struct KeptIdentity {
  Identity identity;
  std::filesystem::path authority;  ///< its certificate, for those who shall believe it
  bool is_new = false;  ///< the authority is: who believed the one before does not know it
};

/// From `folder` (authority.pem and .key, own.pem and .key; the keys are for their owner alone),
/// made there where it is missing, no pair, or of another authority; a new one of the same
/// authority also when other names are wished for, or 30 days before its end. The authority lasts
/// ten years; a name for which it cannot vouch makes a new one. Throws Error where the folder
/// cannot be written, UsageError for names that no certificate can hold.
KeptIdentity keptIdentity(const std::filesystem::path& folder, const IdentityWish& wish,
                          std::chrono::sys_seconds now);

/// What `name`.pem and `name`.key in a folder hold; empty where there is none. And writing both,
/// the key for its owner alone. Throws Error.
Identity heldIdentity(const std::filesystem::path& folder, const std::string& name);
void holdIdentity(const std::filesystem::path& folder, const std::string& name,
                  const Identity& identity);

/// From two files. Throws UsageError where one cannot be read, the key can be read by others, they
/// are no pair, or what they say is over.
Identity identityIn(const std::filesystem::path& certificate, const std::filesystem::path& key,
                    std::chrono::sys_seconds now);

}  // namespace palpa::os
