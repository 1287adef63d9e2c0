#include <gtest/gtest.h>

#include <fstream>

#include "anatomy/base/error.h"
#include "anatomy/base/random.h"
#include "apps/learning/cmi5_launch.h"
#include "apps/learning/lti_launch.h"
#include "apps/learning/lti_scores.h"
#include "apps/learning/signed_token.h"
#include "apps/os/file_access.h"
#include "tests/support/counts.h"
#include "tests/support/files.h"
#include "tests/support/mutations.h"

namespace palpa::learning {
namespace {

using nlohmann::json;
namespace fs = std::filesystem;
constexpr char kOf[] = "https://purl.imsglobal.org/spec/lti/claim/";
const std::chrono::sys_seconds kNow{std::chrono::seconds(1'800'000'000)};

TEST(SignedToken, OfThisConsolesKeyIsBelievedAndNoOther) {
  const fs::path folder = test::freshFolder("learning", "key");
  const SigningKey key(folder / "key.json"), again(folder / "key.json"),
      other(folder / "other.json");
  EXPECT_EQ(key.publicKeys(), again.publicKeys());
  EXPECT_EQ(os::privacyOf(folder / "key.json"), os::Privacy::own);
  EXPECT_FALSE(key.publicKeys().at("keys").at(0).contains("d")) << "the private half";
  const std::string token = key.signedToken({{"a", 1}});
  const std::string keys = key.publicKeys().dump();
  EXPECT_EQ(verifiedClaims(token, keys), (json{{"a", 1}}));
  EXPECT_TRUE(holdsKeyOf(token, keys));
  EXPECT_FALSE(holdsKeyOf(token, other.publicKeys().dump()));
  EXPECT_THROW(verifiedClaims(token, other.publicKeys().dump()), UsageError);
  json renamed = other.publicKeys();
  renamed["keys"][0]["kid"] = key.publicKeys()["keys"][0]["kid"];
  EXPECT_THROW(verifiedClaims(token, renamed.dump()), UsageError) << "the name is not the key";
  for (const char* none : {"", "{}", R"({"kty": "RSA", "n": "a", "e": "AQAB", "d": "!"})"}) {
    std::ofstream(folder / "none.json") << none;
    fs::permissions(folder / "none.json", fs::perms::owner_read | fs::perms::owner_write);
    EXPECT_THROW(SigningKey(folder / "none.json"), Error) << none;
  }
}

/// Whatever comes in place of a token is refused in words, and nothing else happens.
TEST(SignedToken, ThatIsChangedAnywhereIsRefused) {
  const SigningKey key(test::freshFolder("learning", "changed") / "key.json");
  const std::string token = key.signedToken({{"iss", "x"}, {"nonce", "y"}}),
                    keys = key.publicKeys().dump();
  RandomStream random = RandomStream::ofSeed(5);
  const int changes = test::counted(400, 20'000);
  int refused = 0;
  for (int i = 0; i < changes; ++i) {
    std::string changed = token;
    // The last letter of a part has bits that mean nothing: it is left alone.
    const std::size_t at = random.bits() % (changed.size() - 2);
    if (changed[at + 1] == '.') continue;
    const char before = changed[at];
    changed[at] = static_cast<char>(random.bits() % 256);
    if (i % 8 == 0) changed.erase(at, 1 + random.bits() % 3);
    if (changed[at] == before) continue;
    ++refused;
    EXPECT_THROW(verifiedClaims(changed, keys), UsageError) << at;
  }
  EXPECT_GT(refused, changes / 2);
  for (const char* none : {"", ".", "..", "a.b.c", "eyJhbGciOiJub25lIn0.e30."})
    EXPECT_THROW(verifiedClaims(none, keys), UsageError);
  EXPECT_THROW(verifiedClaims(token, "{\"keys\": [1, {\"kid\": []}]}"), UsageError);
  EXPECT_THROW(verifiedClaims(std::string(1u << 20, 'a'), keys), UsageError);
}

/// What a platform publishes may be anything, too.
TEST(SignedToken, OfKeysThatAreDamagedIsRefused) {
  const SigningKey key(test::freshFolder("learning", "keys") / "key.json");
  const std::string token = key.signedToken({{"iss", "x"}}), keys = key.publicKeys().dump();
  test::DamageDice dice(3);
  int believed = 0;
  const int tries = test::counted(1'000, 20'000);
  for (int i = 0; i < tries; ++i) {
    try {
      verifiedClaims(token, test::mutated(keys, dice));
      ++believed;  // what was changed means nothing: a blank, a further field
    } catch (const UsageError&) {
    }
  }
  EXPECT_LT(believed, tries / 4);
}

Platform platform() {
  return {.name = "uni",
          .kind = PlatformKind::lti,
          .issuer = "https://uni.example",
          .client_id = "tool-1",
          .login = "https://uni.example/auth",
          .token = "https://uni.example/token",
          .keys = "https://uni.example/keys",
          .deployments = {"1"}};
}
const Settings kSettings{.address = "https://bench1.local/", .platforms = {platform()}};

json claims() {
  const auto now = kNow.time_since_epoch().count();
  return {{"iss", "https://uni.example"},
          {"aud", "tool-1"},
          {"sub", "17"},
          {"iat", now - 5},
          {"exp", now + 60},
          {"nonce", "n"},
          {std::string(kOf) + "message_type", "LtiResourceLinkRequest"},
          {std::string(kOf) + "version", "1.3.0"},
          {std::string(kOf) + "deployment_id", "1"},
          {std::string(kOf) + "target_link_uri", "https://bench1.local/learning/lti/pulse?x=1"},
          {std::string(kOf) + "launch_presentation", {{"return_url", "https://uni.example/c"}}},
          {"https://purl.imsglobal.org/spec/lti-ags/claim/endpoint",
           {{"scope", {"https://purl.imsglobal.org/spec/lti-ags/scope/score"}},
            {"lineitem", "https://uni.example/items/7?a=1"}}}};
}

LtiLaunch launchOf(const json& said) {
  return readLtiLaunch(said, platform(), "n", kNow, kSettings);
}

TEST(LtiLaunch, SaysWhoWantsWhatAndWhereTheScoreGoes) {
  const LtiLaunch launch = launchOf(claims());
  EXPECT_EQ(launch.person, "17");
  EXPECT_EQ(launch.task, "pulse");
  EXPECT_EQ(launch.return_url, "https://uni.example/c");
  EXPECT_EQ(launch.line_item, "https://uni.example/items/7?a=1");
  json custom = claims();
  custom[std::string(kOf) + "custom"] = {{"task", "search"}};
  EXPECT_EQ(launchOf(custom).task, "search");
  json two = claims();
  two["aud"] = {"tool-1", "tool-2"};
  two["azp"] = "tool-1";
  EXPECT_NO_THROW(launchOf(two));
}

/// Nobody is sent, and no score goes, where the platform is not.
TEST(LtiLaunch, TakesNoAddressOfAnotherPlace) {
  json said = claims();
  said[std::string(kOf) + "launch_presentation"]["return_url"] = "https://other.example/";
  said["https://purl.imsglobal.org/spec/lti-ags/claim/endpoint"]["lineitem"] =
      "https://other.example/7";
  EXPECT_EQ(launchOf(said).return_url, "");
  EXPECT_EQ(launchOf(said).line_item, "");
  json unscoped = claims();
  unscoped["https://purl.imsglobal.org/spec/lti-ags/claim/endpoint"]["scope"] = {"read"};
  EXPECT_EQ(launchOf(unscoped).line_item, "");
}

TEST(LtiLaunch, RefusesWhateverIsMissingOrOfAnotherKind) {
  const json all = claims();
  for (const auto& [field, value] : all.items()) {
    if (field.find("lti-ags") != std::string::npos ||
        field.find("launch_presentation") != std::string::npos)
      continue;
    for (const json& instead : {json(), json(7.5), json("other"), json::array(), json::object()}) {
      json said = claims();
      if (instead.is_null())
        said.erase(field);
      else
        said[field] = instead;
      if (field == "sub" && instead == "other") continue;   // somebody else
      if (field == "iat" && instead.is_number()) continue;  // long ago
      EXPECT_THROW(launchOf(said), UsageError) << field << " " << instead.dump();
    }
  }
}

TEST(LtiScore, IsTriedAgainWhereThatMayHelp) {
  for (const int good : {200, 201, 204, 409})
    EXPECT_EQ(deliveredBy(good, "").how, Delivery::done) << good;
  for (const int later : {0, 401, 403, 408, 429, 500, 503})
    EXPECT_EQ(deliveredBy(later, "no way").how, Delivery::later) << later;
  for (const int never : {400, 404, 415, 422})
    EXPECT_EQ(deliveredBy(never, "").how, Delivery::refused) << never;
}

/// A launch's address may hold anything.
TEST(Cmi5Request, OfAnyFieldsIsReadOrRefusedInWords) {
  const Settings settings{.address = "https://bench1.local/",
                          .platforms = {{.name = "campus", .origin = "https://lms.example"}}};
  const Fields good{{"endpoint", "https://lms.example/xapi"},
                    {"fetch", "https://lms.example/fetch?k=1"},
                    {"registration", "5f2d6f8e-6e6d-4d3f-9a3c-2b1f0c9d8e7a"},
                    {"activityId", "https://lms.example/4"},
                    {"actor", R"({"account":{"homePage":"https://lms.example","name":"17"}})"}};
  EXPECT_EQ(readCmi5Request(good, settings).platform->name, "campus");
  test::DamageDice dice(11);
  int read = 0;
  for (int i = 0; i < test::counted(2'000, 100'000); ++i) {
    Fields fields = good;
    std::string& value = fields[dice.below(fields.size())].second;
    value = test::mutated(value, dice);
    try {
      const Cmi5Request request = readCmi5Request(fields, settings);
      ++read;
      EXPECT_TRUE(originOf(request.endpoint) == "https://lms.example") << request.endpoint;
    } catch (const UsageError&) {
    }
  }
  EXPECT_GT(read, 0);
}

}  // namespace
}  // namespace palpa::learning
