#include "apps/console/place.h"

#include <gtest/gtest.h>

#include <set>

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
  for (const char* name : {"report.html", "trials.csv", "view-01-01-start.png", "view-a.png",
                           "exam-12.html", "certificate-3.pdf"})
    EXPECT_TRUE(isShown(name)) << name;
  for (const std::string name : {"",
                                 "session.palpa",
                                 "session.palpa-wal",
                                 "console.json",
                                 "log.txt",
                                 "report.html.bak",
                                 "Report.html",
                                 "../report.html",
                                 "report.html/",
                                 "./report.html",
                                 "view-.png",
                                 "view-../x.png",
                                 "view-a.png.html",
                                 "view-a/b.png",
                                 "view-a.PNG",
                                 "view-.....png",
                                 "xview-a.png",
                                 "camera.mjpeg",
                                 "view-a.svg",
                                 "rating-1.csv",
                                 "exam-1.html.part",
                                 "exam-.html",
                                 "exam-../x.html",
                                 "certificate-1.html",
                                 "certificate-a b.pdf"})
    EXPECT_FALSE(isShown(name)) << name;
  EXPECT_FALSE(isShown(std::string("report.html\0", 12)));
  EXPECT_FALSE(isShown(std::string("view-a\0.png", 11)));
  EXPECT_FALSE(isShown("view-" + std::string(10'000, 'a') + ".png"));
}

}  // namespace
}  // namespace palpa::console
