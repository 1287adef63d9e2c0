#pragma once

#include <chrono>
#include <string>
#include <vector>

/// Certificates (X.509 v3) of a room's own: an authority made once, which vouches for stations and
/// consoles. Keys are of the curve P-256, signatures ECDSA with SHA-256. What time it is, `now`, is
/// said by whoever asks.
namespace palpa::os {

/// A certificate and the key that belongs to it, both as PEM text. Who has the key is whom the
/// certificate names: it stays where only its owner can read it.
struct Identity {
  std::string certificate, key;
};

/// What an identity may do.
enum class Purpose {
  server,  ///< be reached by its names
  client   ///< say who it is
};

struct IdentityWish {
  std::string name;                     ///< for people: "Palpa console of station3"
  std::vector<std::string> reached_by;  ///< of a server: host names and addresses in figures
  Purpose purpose = Purpose::server;
  std::chrono::days lasts{397};  ///< as long as public ones may: every browser takes it
};

/// A computer's name as a certificate has it: small letters; addresses in their usual form. Throws
/// UsageError for what is none.
std::string usualForm(const std::string& name);

/// It vouches for others, and for itself; of servers only for these names, for names that end in
/// .local, and for addresses within a house: who steals its key can pretend to be no web site.
/// Throws Error where OpenSSL fails, UsageError for a name that is none.
Identity makeAuthority(const std::string& name, const std::vector<std::string>& also_for,
                       std::chrono::days lasts, std::chrono::sys_seconds now);
/// Throws UsageError for a name that no certificate can hold.
Identity makeIdentity(const IdentityWish& wish, const Identity& authority,
                      std::chrono::sys_seconds now);

/// What a certificate says; of a chain the first.
struct CertificateFacts {
  std::string name, issuer;             ///< common names
  std::vector<std::string> reached_by;  ///< host names and addresses, sorted
  std::chrono::sys_seconds from, until;
  std::string fingerprint;  ///< SHA-256, "AB:CD:...": what people compare
};
/// Throws UsageError where the text holds no certificate.
CertificateFacts factsOf(const std::string& certificate, const std::string& where);
/// Whether `key` is the one that `certificate` was made for. Of what is neither: no.
bool belongTogether(const Identity& identity);
/// Whether an authority has vouched for a certificate that is valid now.
bool isVouchedFor(const std::string& certificate, const std::string& authority,
                  std::chrono::sys_seconds now);

}  // namespace palpa::os
