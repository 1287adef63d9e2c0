#include "apps/learning/settings.h"

#include <algorithm>
#include <nlohmann/json.hpp>

#include "anatomy/base/error.h"
#include "anatomy/base/json_text.h"
#include "anatomy/base/whole_file.h"
#include "apps/link/lrs_client.h"
#include "apps/os/file_access.h"

namespace palpa::learning {
namespace {

using nlohmann::json;
constexpr std::size_t kLongestAddress = 2'000, kLongestName = 32;

struct TextField {
  const char* name;
  std::string Platform::*field;
};
constexpr TextField kTexts[] = {{"name", &Platform::name},     {"origin", &Platform::origin},
                                {"issuer", &Platform::issuer}, {"client_id", &Platform::client_id},
                                {"login", &Platform::login},   {"token", &Platform::token},
                                {"keys", &Platform::keys}};

json toJson(const Platform& platform) {
  json one{{"kind", platform.kind == PlatformKind::lti ? "lti" : "cmi5"}};
  for (const auto& [name, field] : kTexts)
    if (!(platform.*field).empty()) one[name] = platform.*field;
  if (!platform.deployments.empty()) one["deployments"] = platform.deployments;
  return one;
}

Platform platformIn(const json& one) {
  Platform platform;
  platform.kind = one.at("kind") == "lti" ? PlatformKind::lti : PlatformKind::cmi5;
  for (const auto& [name, field] : kTexts) platform.*field = one.value(name, "");
  platform.deployments = one.value("deployments", std::vector<std::string>());
  return platform;
}

bool isPlainName(const std::string& name) {
  return !name.empty() && name.size() <= kLongestName &&
         std::all_of(name.begin(), name.end(),
                     [](unsigned char c) { return std::isalnum(c) != 0 || c == '-' || c == '_'; });
}

void requireWhole(const Platform& p) {
  if (!isPlainName(p.name))
    throw UsageError("is no name of a platform", "\"" + p.name.substr(0, kLongestName) + "\"",
                     "Take letters, digits, - and _");
  if (p.kind == PlatformKind::cmi5) {
    originOf(p.origin);
    return;
  }
  for (const std::string* url : {&p.login, &p.token, &p.keys}) originOf(*url);
  if (p.issuer.empty() || p.client_id.empty() || p.deployments.empty())
    throw UsageError("needs issuer, client id and deployment", "platform " + p.name,
                     "Take them from the platform's page of the registered tool");
}

}  // namespace

const Platform* Settings::named(const std::string& name) const {
  const auto found = std::find_if(platforms.begin(), platforms.end(),
                                  [&](const Platform& p) { return p.name == name; });
  return found == platforms.end() ? nullptr : &*found;
}

const Platform* Settings::ofOrigin(const std::string& url) const {
  const std::string origin = originOf(url);
  const auto found = std::find_if(platforms.begin(), platforms.end(), [&](const Platform& p) {
    return p.kind == PlatformKind::cmi5 && originOf(p.origin) == origin;
  });
  return found == platforms.end() ? nullptr : &*found;
}

Settings readSettings(const Folder& folder) {
  const auto text = readWhole(folder.settings());
  if (!text) return {};
  try {
    const json all = parseJson(*text);
    Settings settings;
    settings.address = all.at("address");
    settings.performer = all.value("operator", "person");
    settings.trials = all.value("trials", 1);
    for (const json& one : all.at("platforms")) settings.platforms.push_back(platformIn(one));
    readOwnFile([&] { requireUsable(settings); });
    return settings;
  } catch (const json::exception& e) {
    throw Error(whyNoJson(*text, e), folder.settings().string(),
                "Correct it, or remove it and give the platforms again: palpa console learning "
                "--help");
  }
}

void writeSettings(const Folder& folder, const Settings& settings) {
  requireUsable(settings);
  if (const std::error_code problem = os::makeFolders(folder.path))
    failFile("cannot be used", folder.path, problem);
  json platforms = json::array();
  for (const Platform& platform : settings.platforms) platforms.push_back(toJson(platform));
  const json all{{"address", settings.address},
                 {"operator", settings.performer},
                 {"trials", settings.trials},
                 {"platforms", platforms}};
  writeWhole(folder.settings(), all.dump(1) + "\n", Lasts::yes, Readers::owner);
}

void requireUsable(const Settings& s) {
  constexpr int kMostTrials = 50;
  if (s.isOff()) return;
  originOf(s.address);
  if (!s.address.ends_with("/"))
    throw UsageError("does not end in /", "the console's address " + s.address, "Add it");
  if (s.performer != "person" && s.performer != "expert" && s.performer != "novice")
    throw UsageError("is not one of person, expert, novice", "operator " + s.performer,
                     "Choose one of them");
  if (s.trials < 1 || s.trials > kMostTrials)
    throw UsageError("is not from 1 to 50", "trials", "Change it");
  for (const Platform& platform : s.platforms) requireWhole(platform);
}

std::string originOf(const std::string& url) { return targetOf(url).server.origin; }

Target targetOf(const std::string& url) {
  const auto refuseUrl = [&](const char* why) {
    throw UsageError(why, "address \"" + url.substr(0, 80) + "\"", "Give it in full, with https");
  };
  if (url.size() > kLongestAddress) refuseUrl("is too long");
  for (const unsigned char c : url)
    if (c <= ' ' || c == '\\' || c >= 0x7f) refuseUrl("holds more than an address");
  const std::size_t authority = url.find("//");
  if (authority == std::string::npos) refuseUrl("is no address");
  const std::size_t path = std::min(url.find_first_of("/?#", authority + 2), url.size());
  Target target{{}, url.substr(path, url.find('#') - path)};
  try {
    target.server = link::endpointOf(url.substr(0, path), false);
  } catch (const UsageError&) {
    refuseUrl("is none that may be asked: https, or http on this computer, without a password");
  }
  if (!target.path.starts_with("/")) target.path = "/" + target.path;
  return target;
}

}  // namespace palpa::learning
