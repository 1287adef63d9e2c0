#include "anatomy/base/utc.h"

#include <gtest/gtest.h>

namespace palpa {
namespace {

TEST(Utc, Days) {
  const auto day = [](const char* text) { return utcDayOf(text).time_since_epoch().count(); };
  EXPECT_EQ(day("1970-01-01"), 0);
  EXPECT_EQ(day("2000-03-01T00:00:00Z"), 11017);
  EXPECT_EQ(day("2026-02-30"), 0);
  EXPECT_EQ(day("soon"), 0);
  for (const char* date : {"1970-01-01", "2024-02-29", "2026-12-31"})
    EXPECT_EQ(isoDate(utcDayOf(date)), date);
  EXPECT_EQ(isoDate(dateIn("2026-12-31T23:59:59Z").value()), "2026-12-31");
  for (const char* none : {"", "soon", "2026-02-30", "2026-13-01"}) EXPECT_FALSE(dateIn(none));
}

TEST(Utc, Seconds) {
  const auto second = [](const char* text) {
    return utcSecondsOf(text).time_since_epoch().count();
  };
  EXPECT_EQ(second("1970-01-02T01:02:03Z"), 86400 + 3723);
  EXPECT_EQ(second("yesterday"), 0);
  for (const char* time : {"1970-01-01T00:00:00Z", "2024-02-29T23:59:59Z", "2026-12-31T12:30:00Z"})
    EXPECT_EQ(isoTime(utcSecondsOf(time)), time);
}

TEST(IsoTimes, OfClocksThatJumpedAndOfDamage) {
  EXPECT_EQ(isoTimestamp("2026-12-31T23:59:59Z", 1'500'000'000), "2027-01-01T00:00:00.500Z");
  EXPECT_EQ(isoTimestamp("1970-01-01T00:00:00Z", -1'000'000'000), "1969-12-31T23:59:59.000Z");
  for (const char* none :
       {"", "yesterday", "2026-13-01T00:00:00Z", "2026-03-01T10:00:00", "2026-03-01 10:00:00+1"})
    EXPECT_EQ(isoTimestamp(none, 0), "") << none;
  EXPECT_EQ(isoDuration(-1), "PT0.00S");
  EXPECT_EQ(isoDuration(3600.999), "PT3601.00S");
}

}  // namespace
}  // namespace palpa
