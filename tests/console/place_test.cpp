#include "apps/console/place.h"

#include <gtest/gtest.h>

#include <fstream>
#include <set>

#include "anatomy/base/error.h"
#include "tests/support/scratch_folder.h"

namespace palpa::console {
namespace {

TEST(Place, OnlyPlainNamesAreIds) {
  for (const std::string id : {"a", "T017", "20260301-123000-1a2b3c4d", "A_b-9"})
    EXPECT_TRUE(isId(id)) << id;
  EXPECT_TRUE(isId(std::string(64, 'x')));
  for (const std::string id :
       {"",     ".",     "..",   "../x",   "x/..",   "/etc/passwd", "a/b",
        "a\\b", "a b",   "a.b",  "%2e%2e", "a%00",   "a\n",         "\r",
        "~",    "$HOME", "`id`", "a;b",    "\u00e9", "\u202e",      "\uff0e\uff0e",
        "\xff", "a'",    "\"",   "<b>",    "*",      "?",           "C:"})
    EXPECT_FALSE(isId(id)) << id;
  EXPECT_FALSE(isId(std::string(65, 'x')));
  EXPECT_FALSE(isId(std::string("a\0b", 3)));
  EXPECT_FALSE(isId(std::string(1, '\0')));
  EXPECT_FALSE(isId(std::string(1'000'000, 'x')));
  for (int c = 0; c < 256; ++c) {
    const std::string id(1, static_cast<char>(c));
    EXPECT_EQ(isId(id), c < 128 && (std::isalnum(c) || c == '-' || c == '_')) << c;
  }
}

TEST(Place, NewIdsAreIdsInTheOrderOfTimeAndNeverTwice) {
  std::set<std::string> ids;
  std::string day;
  for (int i = 0; i < 500; ++i) {
    const std::string id = newId();
    EXPECT_TRUE(isId(id));
    EXPECT_GE(id.substr(0, 15), day);
    day = id.substr(0, 15);
    ids.insert(id);
  }
  EXPECT_EQ(ids.size(), 500u);
}

TEST(Place, OnlyWhatASessionShowsIsShown) {
  for (const char* name : {"report.html", "trials.csv", "view-01-01-start.png", "view-a.png"})
    EXPECT_TRUE(isShown(name)) << name;
  for (const std::string name :
       {"", "session.palpa", "session.palpa-wal", "console.json", "log.txt", "report.html.bak",
        "Report.html", "../report.html", "report.html/", "./report.html", "view-.png",
        "view-../x.png", "view-a.png.html", "view-a/b.png", "view-a.PNG", "view-.....png",
        "xview-a.png", "camera.mjpeg", "view-a.svg"})
    EXPECT_FALSE(isShown(name)) << name;
  EXPECT_FALSE(isShown(std::string("report.html\0", 12)));
  EXPECT_FALSE(isShown(std::string("view-a\0.png", 11)));
  EXPECT_FALSE(isShown("view-" + std::string(10'000, 'a') + ".png"));
}

ConsolePlace placeIn(const test::ScratchFolder& folder) {
  ConsolePlace place;
  place.home = folder.path();
  return place;
}

TEST(Place, TheChosenStationIsKept) {
  const test::ScratchFolder folder("station");
  const ConsolePlace place = placeIn(folder);
  EXPECT_EQ(stationOf(place), "");
  std::ofstream(folder / "my \"station\" \u00e4.json") << "{}";
  chooseStation(place, folder / "my \"station\" \u00e4.json");
  EXPECT_EQ(stationOf(place), (folder / "my \"station\" \u00e4.json").string());
  std::filesystem::remove(folder / "my \"station\" \u00e4.json");
  EXPECT_EQ(stationOf(place), "") << "it was removed";
}

/// Never the virtual bench in silence where another station was chosen: an error that says which
/// file it is.
TEST(Place, DamagedSettingsAreSaid) {
  const test::ScratchFolder folder("damaged");
  const ConsolePlace place = placeIn(folder);
  for (const std::string text :
       {"", "{", "[]", "null", "1", "{\"station\": 5}", "{\"station\": [\"x\"]}", "\xff\xfe",
        "{\"station\": \"x\"", "not json"}) {
    std::ofstream(place.settings(), std::ios::binary) << text;
    try {
      EXPECT_EQ(stationOf(place), "") << text;
      ADD_FAILURE() << "was taken: " << text;
    } catch (const Error& e) {
      EXPECT_NE(std::string(e.what()).find("settings.json"), std::string::npos)
          << text << ": " << e.what();
    }
  }
  std::ofstream(place.settings(), std::ios::binary) << "{}";
  EXPECT_EQ(stationOf(place), "");
  std::ofstream(place.settings(), std::ios::binary) << std::string(100'000, '[');
  EXPECT_THROW(stationOf(place), Error);
}

}  // namespace
}  // namespace palpa::console
