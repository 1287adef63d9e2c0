#include "apps/console/stations.h"

#include <gtest/gtest.h>

#include <fstream>

#include "anatomy/base/error.h"
#include "apps/station/assets.h"
#include "tests/support/complaint.h"
#include "tests/support/files.h"

/// Each kind of task at a station of its own.
namespace palpa::console {
namespace {

namespace fs = std::filesystem;

ConsolePlace placeIn(const std::string& name) {
  ConsolePlace place;
  place.home = test::freshFolder("console", name);
  return place;
}

/// What the settings' file says is wrong with it; empty: nothing.
std::string complaintAbout(const ConsolePlace& place) {
  return test::complaint([&] { stationFile(place, StationKind::needle); });
}

std::string shipped(const char* file) { return station::assetFile(file).string(); }

TEST(Stations, EveryTaskHasOneThatItCanBeHeldAt) {
  const ConsolePlace place = placeIn("stations_shipped");
  EXPECT_EQ(stationKindOf(training::Engine::needle), StationKind::needle);
  for (const training::Engine engine : {training::Engine::palpation, training::Engine::squeeze,
                                        training::Engine::friction, training::Engine::pulse})
    EXPECT_TRUE(stationNow(place, stationKindOf(engine)).sample) << training::nameOf(engine);
  EXPECT_TRUE(stationNow(place, stationKindOf(training::Engine::search)).floor);
  EXPECT_FALSE(stationNow(place, StationKind::needle).landmarks.empty());
  for (const StationKind kind : kStationKinds) EXPECT_TRUE(onBench(place, kind));
  chooseStation(place, StationKind::needle, shipped("stations/falcon.json"));
  EXPECT_FALSE(onBench(place, StationKind::needle)) << "a device to hold";
}

/// One that is calibrated is used for what it is for, and for nothing else.
TEST(Stations, ChoosingOneLeavesTheOthers) {
  const ConsolePlace place = placeIn("stations_chosen");
  chooseStation(place, StationKind::needle, shipped("stations/falcon.json"));
  EXPECT_EQ(stationFile(place, StationKind::needle), shipped("stations/falcon.json"));
  EXPECT_EQ(stationFile(place, StationKind::touch), "");
  chooseStation(place, StationKind::touch, shipped("stations/palpation_bench.json"));
  EXPECT_EQ(stationFile(place, StationKind::needle), shipped("stations/falcon.json"));
  EXPECT_TRUE(stationNow(place, StationKind::touch).sample);
  std::vector<std::string> arguments{"train"};
  addStation(place, StationKind::floor, &arguments);
  EXPECT_EQ(arguments.size(), 1u);
  addStation(place, StationKind::needle, &arguments);
  ASSERT_EQ(arguments.size(), 5u);
  EXPECT_EQ(arguments[2], shipped("stations/falcon.json"));
}

/// A home of before: one file for all tasks, whatever it was good for.
TEST(Stations, SettingsOfBeforeCountForTheKindOfTheirFile) {
  for (const auto& [file, kind] : {std::pair{"stations/palpation_bench.json", StationKind::touch},
                                   std::pair{"stations/search_bench.json", StationKind::floor},
                                   std::pair{"stations/falcon.json", StationKind::needle}}) {
    const ConsolePlace place = placeIn("stations_before");
    std::ofstream(place.settings()) << R"({"station": ")" << shipped(file) << "\"}";
    for (const StationKind one : kStationKinds)
      EXPECT_EQ(stationFile(place, one), one == kind ? shipped(file) : "") << file;
  }
}

TEST(Stations, TheChosenOneIsKeptWhateverItsName) {
  const ConsolePlace place = placeIn("stations_kept");
  EXPECT_EQ(stationFile(place, StationKind::needle), "");
  const fs::path file = place.home / "my \"station\" \u00e4.json";
  fs::copy_file(shipped("stations/virtual_bench.json"), file);
  chooseStation(place, file.string());
  EXPECT_EQ(stationFile(place, StationKind::needle), file.string());
  fs::remove(file);
  EXPECT_EQ(stationFile(place, StationKind::needle), "") << "it was removed";
}

/// Choosing anew is the way out of settings, or a file, that cannot be read.
TEST(Stations, AnotherCanBeChosenWhereTheOldOneIsDamaged) {
  const ConsolePlace place = placeIn("stations_way_out");
  std::ofstream(place.home / "damaged.json") << "{";
  std::ofstream(place.settings()) << R"({"station": ")" << (place.home / "damaged.json").string()
                                  << "\"}";
  EXPECT_THROW(stationFile(place, StationKind::touch), Error);
  chooseStation(place, shipped("stations/falcon.json"));
  EXPECT_EQ(stationFile(place, StationKind::needle), shipped("stations/falcon.json"));
  EXPECT_EQ(stationFile(place, StationKind::touch), "");
}

/// Never the virtual bench in silence where another station was chosen: an error that says which
/// file it is.
TEST(Stations, DamagedSettingsAreSaid) {
  const ConsolePlace place = placeIn("stations_damaged");
  for (const std::string text :
       {"", "{", "[]", "null", "1", "{\"station\": 5}", "{\"station\": [\"x\"]}", "\xff\xfe",
        "{\"station\": \"x\"", "not json", "{\"stations\": {\"needle\": 5}}",
        "{\"stations\": [\"x\"]}"}) {
    std::ofstream(place.settings(), std::ios::binary) << text;
    EXPECT_TRUE(test::says(complaintAbout(place), "settings.json")) << text;
  }
  std::ofstream(place.settings(), std::ios::binary) << "{}";
  EXPECT_EQ(stationFile(place, StationKind::needle), "");
  std::ofstream(place.settings(), std::ios::binary) << std::string(100'000, '[');
  EXPECT_THROW(stationFile(place, StationKind::needle), Error);
  EXPECT_THROW(stationKindNamed("kitchen"), UsageError);
  EXPECT_EQ(stationKindNamed("floor"), StationKind::floor);
}

}  // namespace
}  // namespace palpa::console
