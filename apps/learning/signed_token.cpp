#include "apps/learning/signed_token.h"

#include <cjose/cjose.h>

#include <algorithm>
#include <cctype>
#include <optional>

#include "anatomy/base/error.h"
#include "anatomy/base/json_text.h"
#include "anatomy/base/uuid.h"
#include "anatomy/base/whole_file.h"
#include "apps/os/file_access.h"

namespace palpa::learning {

struct ReleasesKey {
  void operator()(cjose_jwk_t* key) const { cjose_jwk_release(key); }
};
struct ReleasesHead {
  void operator()(cjose_header_t* head) const { cjose_header_release(head); }
};
struct ReleasesToken {
  void operator()(cjose_jws_t* token) const { cjose_jws_release(token); }
};
using JoseKey = std::unique_ptr<cjose_jwk_t, ReleasesKey>;
using JoseHead = std::unique_ptr<cjose_header_t, ReleasesHead>;
using JoseToken = std::unique_ptr<cjose_jws_t, ReleasesToken>;

namespace {

using nlohmann::json;
constexpr std::size_t kLongestToken = 32u << 10, kLeastBits = 2048;

[[noreturn]] void refuseToken(const std::string& why) {
  throw UsageError(why, "the platform's token", "Start again from the course");
}

std::string headField(cjose_jws_t* token, const char* field) {
  cjose_err error{};
  const char* const value = cjose_header_get(cjose_jws_get_protected(token), field, &error);
  return value ? value : "";
}

/// Base64 of RFC 4648, section 5, as it may be: cjose ends the program over what is not.
bool isBase64Url(std::string_view text) {
  constexpr std::size_t kGroup = 4;
  return text.size() % kGroup != 1 && std::all_of(text.begin(), text.end(), [](unsigned char c) {
           return std::isalnum(c) != 0 || c == '-' || c == '_';
         });
}

/// Three parts with a full stop between them.
bool hasForm(std::string_view token) {
  constexpr int kParts = 3;
  if (token.empty() || token.size() > kLongestToken) return false;
  for (int part = 1; part < kParts; ++part) {
    const std::size_t stop = token.find('.');
    if (stop == std::string_view::npos || !isBase64Url(token.substr(0, stop))) return false;
    token.remove_prefix(stop + 1);
  }
  return isBase64Url(token);
}

JoseToken imported(const std::string& token) {
  cjose_err error{};
  if (!hasForm(token)) return nullptr;
  return JoseToken(cjose_jws_import(token.data(), token.size(), &error));
}

/// The public key of that name, whatever else the set holds.
std::optional<json> keyNamed(const std::string& kid, const std::string& keys) {
  const json set = parsedOrDiscarded(keys);
  if (kid.empty() || !set.is_object() || !set.contains("keys") || !set["keys"].is_array())
    return std::nullopt;
  for (const json& key : set["keys"])
    if (key.is_object() && key.value("kid", json()) == kid) return key;
  return std::nullopt;
}

JoseKey verifyingKey(const json& key) {
  cjose_err error{};
  if (key.value("kty", json()) != "RSA" || key.value("use", json("sig")) != "sig" ||
      key.value("alg", json("RS256")) != "RS256")
    refuseToken("names a key that is not for RS256");
  for (const char* number : {"n", "e"})
    if (const json value = key.value(number, json()); !value.is_string() ||
                                                      value.get<std::string>().empty() ||
                                                      !isBase64Url(value.get<std::string>()))
      refuseToken("names a key that is none, or too short");
  const std::string text =
      json{{"kty", "RSA"}, {"n", key["n"]}, {"e", key["e"]}}.dump();  // and nothing else
  JoseKey made(cjose_jwk_import(text.data(), text.size(), &error));
  if (!made || cjose_jwk_get_keysize(made.get(), &error) < kLeastBits)
    refuseToken("names a key that is none, or too short");
  return made;
}

}  // namespace

bool holdsKeyOf(const std::string& token, const std::string& keys) {
  const JoseToken read = imported(token);
  return read && keyNamed(headField(read.get(), CJOSE_HDR_KID), keys).has_value();
}

json verifiedClaims(const std::string& token, const std::string& keys) {
  const JoseToken read = imported(token);
  if (!read) refuseToken("is no signed token");
  if (headField(read.get(), CJOSE_HDR_ALG) != CJOSE_HDR_ALG_RS256)
    refuseToken("is not signed by RS256");
  const std::optional<json> named = keyNamed(headField(read.get(), CJOSE_HDR_KID), keys);
  if (!named) refuseToken("names a key that the platform does not publish");
  const JoseKey key = verifyingKey(*named);
  cjose_err error{};
  if (!cjose_jws_verify(read.get(), key.get(), &error))
    refuseToken("has a signature that is not the platform's");
  std::uint8_t* bytes = nullptr;
  std::size_t size = 0;
  if (!cjose_jws_get_plaintext(read.get(), &bytes, &size, &error))
    refuseToken("holds nothing that can be read");
  json claims = parsedOrDiscarded({reinterpret_cast<const char*>(bytes), size});
  if (!claims.is_object()) refuseToken("holds no claims");
  return claims;
}

struct SigningKey::Impl {
  JoseKey key;
  std::string kid;
};

namespace {

/// cjose's texts are freed by its own means.
std::string textOf(const cjose_jwk_t* key, bool with_private) {
  cjose_err error{};
  char* const text = cjose_jwk_to_json(key, with_private, &error);
  if (!text) throw Error("cannot be written as text", "this console's key", "Restart the console");
  std::string copied(text);
  cjose_get_dealloc()(text);
  return copied;
}

JoseKey madeKey() {
  constexpr std::uint8_t kExponent[] = {1, 0, 1};
  cjose_err error{};
  JoseKey key(cjose_jwk_create_RSA_random(kLeastBits, kExponent, sizeof kExponent, &error));
  const std::string kid = newUuid();
  if (!key || !cjose_jwk_set_kid(key.get(), kid.data(), kid.size(), &error))
    throw Error("cannot be made", "this console's key", "Look whether its OpenSSL is complete");
  return key;
}

JoseKey keptKey(const std::filesystem::path& file) {
  if (os::privacyOf(file) == os::Privacy::missing) {
    JoseKey key = madeKey();
    writeWhole(file, textOf(key.get(), true), Lasts::yes, Readers::owner);
    return key;
  }
  if (os::privacyOf(file) == os::Privacy::shared)
    throw Error("may be read by others", file.string(), "chmod 600 " + file.string());
  cjose_err error{};
  const std::string text = readWhole(file).value_or("");
  const json kept = parsedOrDiscarded(text);
  const bool is_whole =
      kept.is_object() && std::all_of(kept.begin(), kept.end(), [](const json& one) {
        return one.is_string() && isBase64Url(one.get<std::string>());
      });
  JoseKey key(is_whole ? cjose_jwk_import(text.data(), text.size(), &error) : nullptr);
  if (!key || !cjose_jwk_get_kid(key.get(), &error))
    throw Error("holds no key", file.string(),
                "Remove it: a new one is made, which platforms then fetch");
  return key;
}

}  // namespace

SigningKey::SigningKey(const std::filesystem::path& file) : impl_(std::make_unique<Impl>()) {
  cjose_err error{};
  impl_->key = keptKey(file);
  impl_->kid = cjose_jwk_get_kid(impl_->key.get(), &error);
}
SigningKey::~SigningKey() = default;

json SigningKey::publicKeys() const {
  json key = parseJson(textOf(impl_->key.get(), false));
  key["use"] = "sig";
  key["alg"] = "RS256";
  return {{"keys", json::array({key})}};
}

std::string SigningKey::signedToken(const json& claims) const {
  cjose_err error{};
  const JoseHead head(cjose_header_new(&error));
  const std::string text = claims.dump();
  const bool headed = head &&
                      cjose_header_set(head.get(), CJOSE_HDR_ALG, CJOSE_HDR_ALG_RS256, &error) &&
                      cjose_header_set(head.get(), CJOSE_HDR_KID, impl_->kid.c_str(), &error) &&
                      cjose_header_set(head.get(), "typ", "JWT", &error);
  const JoseToken token(headed ? cjose_jws_sign(impl_->key.get(), head.get(),
                                                reinterpret_cast<const std::uint8_t*>(text.data()),
                                                text.size(), &error)
                               : nullptr);
  const char* compact = nullptr;
  if (!token || !cjose_jws_export(token.get(), &compact, &error))
    throw Error("cannot sign", "this console's key", "Restart the console");
  return compact;
}

}  // namespace palpa::learning
