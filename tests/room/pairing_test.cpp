#include "apps/room/pairing.h"

#include <gtest/gtest.h>

#include <fstream>
#include <thread>
#include <vector>

#include "anatomy/base/error.h"
#include "anatomy/base/utc.h"
#include "anatomy/base/whole_file.h"
#include "apps/os/file_access.h"
#include "tests/support/scratch_folder.h"

namespace palpa::room {
namespace {

namespace fs = std::filesystem;
using std::chrono::days;
const auto kDay = utcSecondsOf("2026-03-01T10:00:00Z");

class Pairings : public testing::Test {
 protected:
  const palpa::test::ScratchFolder scratch_{"pairings"};
  Room room_ = Room::made(scratch_ / "room", "room.local", 8883, kDay);
  std::string rights() const { return *readWhole(scratch_ / "room" / "rights"); }
};

TEST_F(Pairings, ThatAreMadeAtOnceWaitForEachOther) {
  constexpr int kAtOnce = 6;
  std::vector<std::thread> all;
  for (int i = 0; i < kAtOnce; ++i)
    all.emplace_back([&, i] {
      const RoomChange alone(scratch_ / "room");
      Room::in(scratch_ / "room").pair("station" + std::to_string(i), kDay);
    });
  for (std::thread& one : all) one.join();
  EXPECT_EQ(Room::in(scratch_ / "room").stations().size(), kAtOnce);
}

TEST_F(Pairings, AreReadAsTheyAreWrittenByTheirOwnerAlone) {
  const fs::path file = scratch_ / "one.palpa-pairing";
  writePairing(file, room_.pair("one", kDay));
  EXPECT_EQ(os::privacyOf(file), os::Privacy::own);
  const Pairing read = readPairing(file, kDay);
  EXPECT_EQ(read.station, "one");
  EXPECT_EQ(read.broker.host, "room.local");
  EXPECT_EQ(read.broker.port, 8883);
  EXPECT_TRUE(
      os::isVouchedFor(read.broker.identity.certificate, read.broker.authority, kDay + days(1800)));
  fs::permissions(file, fs::perms::group_read, fs::perm_options::add);
  EXPECT_THROW(readPairing(file, kDay), UsageError);
  fs::permissions(file, fs::perms::group_read, fs::perm_options::remove);
  EXPECT_THROW(readPairing(file, kDay + days(1826)), UsageError);
}

TEST_F(Pairings, AreRefusedWhereTheyAreDamaged) {
  const fs::path file = scratch_ / "one.palpa-pairing";
  Pairing wrong = room_.pair("one", kDay);
  wrong.broker.identity.key = room_.pair("two", kDay).broker.identity.key;
  writePairing(file, wrong);
  EXPECT_THROW(readPairing(file, kDay), UsageError);
  for (const char* text :
       {"", "{}", R"({"version": 99})", R"({"version": 1, "station": "../x"})"}) {
    writeWhole(file, text, Lasts::no, Readers::owner);
    EXPECT_THROW(readPairing(file, kDay), UsageError) << text;
  }
}

TEST_F(Pairings, GiveAStationItsOwnTopicsAndOnlyByItsNewestCertificate) {
  const std::string first =
      os::factsOf(room_.pair("one", kDay).broker.identity.certificate, "").name;
  EXPECT_NE(rights().find("user " + first + "\ntopic write palpa/one/about\n"), std::string::npos);
  const std::string second =
      os::factsOf(room_.pair("one", kDay).broker.identity.certificate, "").name;
  EXPECT_NE(first, second);
  EXPECT_EQ(rights().find(first), std::string::npos);
  EXPECT_NE(rights().find(second), std::string::npos);
  EXPECT_EQ(rights().find("palpa/#"), std::string::npos);
  // What waits to be told is of the first time; and what cannot be handed over changes nothing.
  EXPECT_EQ(room_.pair("one", kDay + days(9)).made_utc, "2026-03-01T10:00:00Z");
  const std::string before = rights();
  EXPECT_THROW(room_.pair("one", kDay, [](const Pairing&) { throw Error("full", "disk", ""); }),
               Error);
  EXPECT_EQ(rights(), before);
  EXPECT_TRUE(room_.forget("one"));
  EXPECT_FALSE(room_.forget("one"));
  EXPECT_EQ(rights().find("palpa/one/"), std::string::npos);
  EXPECT_THROW(room_.pair("a/b", kDay), UsageError);
  EXPECT_THROW(room_.pair("", kDay), UsageError);
}

TEST_F(Pairings, AreKnownAgain) {
  room_.pair("one", kDay);
  const Room again = Room::in(scratch_ / "room");
  EXPECT_EQ(again.stations(), room_.stations());
  EXPECT_EQ(again.host(), "room.local");
  EXPECT_EQ(again.watcher(kDay).identity.certificate, room_.watcher(kDay).identity.certificate);
  EXPECT_EQ(Room::made(scratch_ / "room", "room.local", 8883, kDay).stations(), room_.stations());
  // Its stations know one place only.
  EXPECT_THROW(Room::made(scratch_ / "room", "room.local", 8884, kDay), UsageError);
  EXPECT_THROW(Room::made(scratch_ / "room", "room.centre.example", 8883, kDay), UsageError);
  EXPECT_THROW(Room::in(scratch_ / "nowhere"), UsageError);
}

}  // namespace
}  // namespace palpa::room
