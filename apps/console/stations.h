#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "apps/console/place.h"
#include "apps/station/station_file.h"
#include "apps/training/engine.h"

/// The stations of a console, by what is done at them. Each kind has a tool of its own and touches
/// something else, so each is a station file of its own, calibrated by itself.
namespace palpa::console {

enum class StationKind { needle, touch, floor };
inline constexpr StationKind kStationKinds[] = {StationKind::needle, StationKind::touch,
                                                StationKind::floor};

const char* nameOf(StationKind kind);   ///< "needle", "touch", "floor"
const char* titleOf(StationKind kind);  ///< "Needle", "Palpation", "Search"
/// Throws UsageError for another word.
StationKind stationKindNamed(const std::string& name);

/// At which a task of this kind is held.
StationKind stationKindOf(training::Engine engine);

/// The file in use (settings); empty: the virtual bench of this kind. And choosing another, kept
/// over restarts. Settings of before, which know one file for all, are read as of its own kind.
std::string stationFile(const ConsolePlace& place, StationKind kind);
void chooseStation(const ConsolePlace& place, StationKind kind, const std::string& file);
/// The same for a file that says itself what it is for. Throws Error for a damaged one.
void chooseStation(const ConsolePlace& place, const std::string& file);

/// The same, with the virtual bench's own file where none was chosen.
std::filesystem::path stationPath(const ConsolePlace& place, StationKind kind);
/// The station in use. Throws Error for a damaged file.
station::Station stationNow(const ConsolePlace& place, StationKind kind);

/// "--station FILE", where one was chosen, with the seed of the bench that was calibrated from
/// here.
void addStation(const ConsolePlace& place, StationKind kind, std::vector<std::string>* arguments);

/// Its device is the virtual bench's: a person holds it with the mouse.
bool onBench(const ConsolePlace& place, StationKind kind);
/// What comes of it is simulated: because of who performs, or of where.
bool isSimulated(const ConsolePlace& place, StationKind kind, const std::string& performer);

}  // namespace palpa::console
