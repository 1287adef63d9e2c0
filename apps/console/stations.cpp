#include "apps/console/stations.h"

#include <filesystem>
#include <nlohmann/json.hpp>
#include <optional>

#include "anatomy/base/error.h"
#include "anatomy/base/json_file.h"
#include "anatomy/base/whole_file.h"
#include "apps/station/assets.h"

namespace palpa::console {
namespace {

namespace fs = std::filesystem;
using training::Engine;

struct Kind {
  StationKind kind;
  const char *name, *title, *bench;
};
constexpr Kind kKindsOfStation[] = {
    {StationKind::needle, "needle", "Needle", "stations/virtual_bench.json"},
    {StationKind::touch, "touch", "Palpation", "stations/palpation_bench.json"},
    {StationKind::floor, "floor", "Search", "stations/search_bench.json"},
};

const Kind& of(StationKind kind) { return kKindsOfStation[static_cast<std::size_t>(kind)]; }

StationKind kindOfFile(const fs::path& file) {
  const station::Station station = station::readStation(file);
  return station.floor    ? StationKind::floor
         : station.sample ? StationKind::touch
                          : StationKind::needle;
}

std::optional<JsonFile> settingsIn(const ConsolePlace& place) {
  std::error_code none;
  if (!fs::exists(place.settings(), none)) return std::nullopt;
  JsonFile file(place.settings());
  if (!file.json().is_object() ||
      !file.json().value("stations", nlohmann::json::object()).is_object())
    throw UsageError("holds no settings", place.settings().string(),
                     "Restore it, or remove it and calibrate again");
  return file;
}

/// Empty where the settings, or the one file that they had for all, cannot be read: choosing anew
/// is the way out of that.
std::string readableFile(const ConsolePlace& place, StationKind kind) {
  try {
    return stationFile(place, kind);
  } catch (const Error&) {
    return "";
  }
}

bool isThere(const std::string& file) {
  std::error_code none;
  return !file.empty() && fs::exists(file, none);
}

}  // namespace

const char* nameOf(StationKind kind) { return of(kind).name; }
const char* titleOf(StationKind kind) { return of(kind).title; }

StationKind stationKindNamed(const std::string& name) {
  for (const Kind& one : kKindsOfStation)
    if (name == one.name) return one.kind;
  throw UsageError("is no kind of station", name.substr(0, 32), "Choose one from the list");
}

StationKind stationKindOf(Engine engine) {
  switch (engine) {
    case Engine::needle:
      return StationKind::needle;
    case Engine::search:
      return StationKind::floor;
    case Engine::palpation:
    case Engine::squeeze:
    case Engine::friction:
    case Engine::pulse:
      break;
  }
  return StationKind::touch;
}

std::string stationFile(const ConsolePlace& place, StationKind kind) {
  const std::optional<JsonFile> settings = settingsIn(place);
  if (!settings) return "";
  const std::string field = std::string("stations/") + nameOf(kind);
  if (settings->has(field)) {
    const std::string chosen = settings->text(field);
    return isThere(chosen) ? chosen : "";
  }
  const std::string one = settings->has("station") ? settings->text("station") : "";
  return isThere(one) && kindOfFile(one) == kind ? one : "";
}

void chooseStation(const ConsolePlace& place, StationKind kind, const std::string& file) {
  nlohmann::json stations = nlohmann::json::object();
  for (const StationKind one : kStationKinds)
    if (const std::string chosen = one == kind ? file : readableFile(place, one); !chosen.empty())
      stations[nameOf(one)] = chosen;
  writeWhole(place.settings(), nlohmann::json{{"stations", stations}}.dump(1) + "\n");
}

void chooseStation(const ConsolePlace& place, const std::string& file) {
  chooseStation(place, kindOfFile(file), file);
}

fs::path stationPath(const ConsolePlace& place, StationKind kind) {
  const std::string chosen = stationFile(place, kind);
  return chosen.empty() ? station::assetFile(of(kind).bench) : fs::path(chosen);
}

station::Station stationNow(const ConsolePlace& place, StationKind kind) {
  return station::readStation(stationPath(place, kind));
}

void addStation(const ConsolePlace& place, StationKind kind, std::vector<std::string>* arguments) {
  if (const std::string chosen = stationFile(place, kind); !chosen.empty())
    arguments->insert(arguments->end(), {"--station", chosen, "--bench-seed", "1"});
}

bool onBench(const ConsolePlace& place, StationKind kind) {
  return stationNow(place, kind).device.driver == station::DeviceDriver::bench;
}

bool isSimulated(const ConsolePlace& place, StationKind kind, const std::string& performer) {
  return performer != "person" || stationNow(place, kind).simulated;
}

}  // namespace palpa::console
