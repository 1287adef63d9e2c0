#pragma once

#include <filesystem>
#include <memory>
#include <nlohmann/json.hpp>
#include <string>

/// JSON Web Tokens signed by RS256 (RFC 7515, 7518, 7519), by cjose.
namespace palpa::learning {

/// The claims of a compact token that one of these keys ({"keys": [...]}, RFC 7517) has signed: the
/// one with the `kid` that its head names, an RSA key of at least 2048 bits. Throws UsageError in
/// plain words for every other token, whatever it says of itself: another algorithm than RS256, no
/// or an unknown `kid`, a wrong signature, claims that are no object.
nlohmann::json verifiedClaims(const std::string& token, const std::string& keys);

/// Whether keys hold one with the `kid` of this token; false also where either is none.
bool holdsKeyOf(const std::string& token, const std::string& keys);

/// This console's own key pair.
class SigningKey {
 public:
  /// The one in `file` (a private JWK, for its owner alone), made there where there is none. Throws
  /// Error where the file holds none, others may read it, or it cannot be written.
  explicit SigningKey(const std::filesystem::path& file);
  ~SigningKey();
  /// {"keys": [...]}: the public half.
  nlohmann::json publicKeys() const;
  std::string signedToken(const nlohmann::json& claims) const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace palpa::learning
