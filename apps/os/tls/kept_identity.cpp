#include "apps/os/tls/kept_identity.h"

#include <algorithm>
#include <chrono>
#include <optional>

#include "anatomy/base/error.h"
#include "anatomy/base/whole_file.h"
#include "apps/os/file_access.h"

namespace palpa::os {
namespace {

namespace fs = std::filesystem;
using std::chrono::days;
constexpr days kAuthorityLasts{3650}, kRenewedBefore{30};

std::chrono::sys_seconds endOf(const Identity& identity) {
  return factsOf(identity.certificate, "the certificate").until;
}

bool isAsWished(const Identity& own, const IdentityWish& wish, const Identity& authority,
                std::chrono::sys_seconds now) {
  if (!belongTogether(own) || !isVouchedFor(own.certificate, authority.certificate, now))
    return false;
  const CertificateFacts facts = factsOf(own.certificate, "the certificate");
  std::vector<std::string> names;
  for (const std::string& name : wish.reached_by) names.push_back(usualForm(name));
  std::sort(names.begin(), names.end());
  return facts.name == wish.name && facts.reached_by == names && facts.until > now + kRenewedBefore;
}

}  // namespace

Identity heldIdentity(const fs::path& folder, const std::string& name) {
  return {readWhole(folder / (name + ".pem")).value_or(""),
          readWhole(folder / (name + ".key")).value_or("")};
}

void holdIdentity(const fs::path& folder, const std::string& name, const Identity& identity) {
  writeWhole(folder / (name + ".key"), identity.key, Lasts::yes, Readers::owner);
  writeWhole(folder / (name + ".pem"), identity.certificate);
}

KeptIdentity keptIdentity(const fs::path& folder, const IdentityWish& wish,
                          std::chrono::sys_seconds now) {
  if (const std::error_code problem = makeFolders(folder))
    failFile("cannot be used", folder, problem, "Look whether this user may write there");
  Identity authority = heldIdentity(folder, "authority"), own = heldIdentity(folder, "own");
  bool is_new = !belongTogether(authority) || endOf(authority) < now + wish.lasts;
  if (!is_new && isAsWished(own, wish, authority, now)) return {own, folder / "authority.pem"};
  if (!is_new) {
    own = makeIdentity(wish, authority, now);
    is_new = !isVouchedFor(own.certificate, authority.certificate, now);
  }
  if (is_new) {
    authority = makeAuthority("Authority of " + wish.name, wish.reached_by, kAuthorityLasts, now);
    own = makeIdentity(wish, authority, now);
    holdIdentity(folder, "authority", authority);
  }
  holdIdentity(folder, "own", own);
  return {std::move(own), folder / "authority.pem", is_new};
}

Identity identityIn(const fs::path& certificate, const fs::path& key,
                    std::chrono::sys_seconds now) {
  const auto textOf = [](const fs::path& file) {
    const std::optional<std::string> text = readWhole(file);
    if (!text) throw UsageError("cannot be read", file.string(), "Check the path");
    return *text;
  };
  Identity identity{textOf(certificate), textOf(key)};
  if (privacyOf(key) == Privacy::shared)
    throw UsageError("may be read by others", key.string(), "chmod 600 " + key.string());
  const CertificateFacts facts = factsOf(identity.certificate, certificate.string());
  if (facts.until <= now)
    throw UsageError("is over", certificate.string(), "Have it renewed by whoever made it");
  if (!belongTogether(identity))
    throw UsageError("is not the key of " + certificate.string(), key.string(),
                     "Give the key that the certificate was made for, without a password, as PEM");
  return identity;
}

}  // namespace palpa::os
