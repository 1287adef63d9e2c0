#include "apps/room/found_consoles.h"

#include <gtest/gtest.h>

#include "tests/support/counts.h"

/// What others announce on the network, well and ill meant.
namespace palpa::room {
namespace {

TxtOfService service(const std::string& name = "Palpa on desk") {
  return {name, "desk.local", 8443, {"version=0.1.0", "station=bench1"}};
}

TEST(FoundConsoles, WhatIsAnnouncedIsFoundAgain) {
  const FoundConsole console{"Palpa on desk", "desk.local", "bench1", "0.1.0", 8443, true};
  EXPECT_EQ(consoleIn({console.name, console.host, console.port, txtOf(console)}), console);
  FoundConsole alone = console;
  alone.station.clear();
  alone.watches = false;
  EXPECT_EQ(consoleIn({alone.name, alone.host, alone.port, txtOf(alone)}), alone);
}

TEST(FoundConsoles, WhatCannotBeShownIsNone) {
  const auto without = [](auto change) {
    TxtOfService one = service();
    change(one);
    return consoleIn(one).has_value();
  };
  EXPECT_TRUE(without([](TxtOfService&) {}));
  EXPECT_FALSE(without([](TxtOfService& s) { s.name = ""; }));
  EXPECT_FALSE(without([](TxtOfService& s) { s.name = std::string(64, 'x'); }));
  for (const int port : {-1, 0, 65536})
    EXPECT_FALSE(without([&](TxtOfService& s) { s.port = port; })) << port;
  for (const std::string host : {"", "a b", "a/b", "a:b@c", "<i>", "\xff"})
    EXPECT_FALSE(without([&](TxtOfService& s) { s.host = host; })) << host;
  EXPECT_FALSE(without([](TxtOfService& s) { s.host = std::string(254, 'a'); }));
}

TEST(FoundConsoles, HostileWordsAreLeftOutAndTheRestIsTold) {
  TxtOfService hostile = service("Palpa\n\x1b[31m\xff \xe2\x80\xae!");
  hostile.txt = {"station=../../etc",
                 "station=bench2",
                 "version=<script>",
                 std::string(300, 'x'),
                 "=",
                 "",
                 "watches=yes",
                 std::string("version\0=1", 10)};
  const auto found = consoleIn(hostile);
  ASSERT_TRUE(found);
  EXPECT_EQ(found->name.find_first_of("\n\x1b\xff"), std::string::npos) << found->name;
  EXPECT_EQ(found->station, "");  // the first of a key counts
  EXPECT_EQ(found->version, "");
  EXPECT_FALSE(found->watches);
  hostile.txt.assign(10'000, "note=x");
  hostile.txt.push_back("station=bench1");
  EXPECT_EQ(consoleIn(hostile)->station, "");  // so far nobody reads
}

TEST(FoundConsoles, AThousandServicesTakeNoMoreThanTheirPlaces) {
  FoundConsoles all;
  const auto name = [](int i) { return "Palpa on " + std::to_string(10'000 + i); };
  for (int i = 0; i < palpa::test::counted(1000, 100'000); ++i)
    all.add("2/0", *consoleIn(service(name(i))));
  EXPECT_TRUE(all.isFull());
  EXPECT_EQ(all.all().size(), FoundConsoles::kMost);
  FoundConsole changed = *consoleIn(service(name(0)));
  changed.port = 1;
  all.add("2/0", changed);  // one that has a place may change
  EXPECT_EQ(all.all().front().port, 1);
  all.remove("2/0", name(0));
  EXPECT_FALSE(all.isFull());
  all.clear();
  EXPECT_TRUE(all.all().empty());
}

TEST(FoundConsoles, OneThatTwoNetworksTellOfIsOneUntilBothLoseIt) {
  FoundConsoles all;
  const FoundConsole one = *consoleIn(service("Palpa\ton desk"));
  all.add("2/0", one);
  all.add("3/1", one);
  EXPECT_EQ(all.all().size(), 1u);
  all.remove("2/0", "Palpa\ton desk");  // as it is announced, not as it is shown
  EXPECT_EQ(all.all().size(), 1u);
  all.remove("3/1", "Palpa\ton desk");
  EXPECT_TRUE(all.all().empty());
}

}  // namespace
}  // namespace palpa::room
