#include "apps/room/found_consoles.h"

#include <algorithm>
#include <string_view>

#include "anatomy/base/text_forms.h"
#include "apps/room/messages.h"

namespace palpa::room {
namespace {

constexpr std::size_t kLongestShown = 63, kLongestHost = 253, kLongestVersion = 32,  // RFC 6763
    kMostTexts = 32;
constexpr char kStationText[] = "station", kVersionText[] = "version", kWatchesText[] = "watches";

bool all(std::string_view text, std::size_t longest, bool (*is)(unsigned char)) {
  return !text.empty() && text.size() <= longest && std::all_of(text.begin(), text.end(), is);
}

bool isOfHost(unsigned char c) {
  return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '-' ||
         c == '.';
}

bool isOfVersion(unsigned char c) { return isOfHost(c) || c == '+' || c == '~'; }

/// As it may stand on a page.
std::string shown(const std::string& name) { return plainText(name, kLongestShown); }

/// The first of this key counts (RFC 6763, 6.4).
std::string valueOf(const char* key, const std::vector<std::string>& txt) {
  const std::string begins = std::string(key) + "=";
  for (std::size_t i = 0; i < std::min(txt.size(), kMostTexts); ++i)
    if (txt[i].starts_with(begins)) return txt[i].substr(begins.size());
  return "";
}

}  // namespace

std::vector<std::string> txtOf(const FoundConsole& c) {
  std::vector<std::string> txt{std::string(kVersionText) + "=" + c.version};
  if (!c.station.empty()) txt.push_back(std::string(kStationText) + "=" + c.station);
  if (c.watches) txt.push_back(std::string(kWatchesText) + "=1");
  return txt;
}

std::optional<FoundConsole> consoleIn(const TxtOfService& service) {
  constexpr int kLastPort = 65535;
  if (service.name.empty() || service.name.size() > kLongestShown ||
      !all(service.host, kLongestHost, isOfHost) || service.port < 1 || service.port > kLastPort)
    return std::nullopt;
  FoundConsole found{shown(service.name),
                     service.host,
                     valueOf(kStationText, service.txt),
                     valueOf(kVersionText, service.txt),
                     service.port,
                     valueOf(kWatchesText, service.txt) == "1"};
  if (!isStationName(found.station)) found.station.clear();
  if (!all(found.version, kLongestVersion, isOfVersion)) found.version.clear();
  return found;
}

void FoundConsoles::add(const std::string& network, const FoundConsole& console) {
  const std::pair key{console.name, network};
  if (isFull() && !all_.contains(key)) return;
  all_[key] = console;
}

void FoundConsoles::remove(const std::string& network, const std::string& name) {
  all_.erase({shown(name), network});
}

std::vector<FoundConsole> FoundConsoles::all() const {
  std::vector<FoundConsole> each;
  for (const auto& [key, console] : all_)
    if (each.empty() || each.back().name != console.name) each.push_back(console);
  return each;
}

}  // namespace palpa::room
