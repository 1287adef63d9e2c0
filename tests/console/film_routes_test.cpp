#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <string>

#include "apps/record/session_file.h"
#include "tests/console/served.h"
#include "tests/support/files.h"

/// The film of a room, as the replay's page asks for it.
namespace palpa::console {
namespace {

namespace fs = std::filesystem;

constexpr std::int64_t kMs = 1'000'000;

/// A trial from 1 s to 6 s of the session, paused from 3 s to 5 s.
void writeEvidence(const fs::path& folder) {
  record::SessionInfo info;
  info.session_json = "{}";
  info.station_json = info.task_json = "{}";
  record::SessionWriter writer(folder / "session.palpa", info);
  writer.beginTrial({1, 1000 * kMs, 7, "scored", true, 0});
  for (std::int64_t ms = 1000; ms <= 6000; ++ms) {
    haptics::FlightRecord tick;
    tick.tick = ms;
    tick.t_ns = ms * kMs;
    tick.commands.trial = 1;
    tick.commands.armed = ms <= 3000 || ms >= 5000;
    writer.tick(tick);
  }
  writer.endTrial({1, 6000 * kMs, "success", "", ""});
  writer.close();
}

constexpr char kPictures[][8] = {"\xff\xd8one", "\xff\xd8two.", "\xff\xd8three",
                                 "\xff\xd8"
                                 "four"};

void writeFilm(const fs::path& folder) {
  std::ofstream film(folder / "room.mjpeg", std::ios::binary);
  std::ofstream table(folder / "room.mjpeg.csv");
  table << "number,t_exposure_ns,offset\n";
  const std::int64_t at_ms[] = {500, 2000, 4000, 5500};
  std::size_t offset = 0;
  for (int i = 0; i < 4; ++i) {
    film << kPictures[i];
    table << i << ',' << at_ms[i] * kMs << ',' << offset << '\n';
    offset += std::string(kPictures[i]).size();
  }
  table << "4,59";  // as a killed session may leave it
}

class FilmRoutes : public testing::Test {
 protected:
  FilmRoutes() : place_("film-routes") {
    fs::create_directories(folder());
    writeEvidence(folder());
    writeFilm(folder());
    std::ofstream(folder() / "report.html") << "the report";
    describe(false);
  }
  void describe(bool blind) {
    std::ofstream(folder() / "console.json") << json{{"task", "paracentesis"},
                                                     {"title", "Access"},
                                                     {"trainee", ""},
                                                     {"started_utc", "2026-11-30T10:00:00Z"},
                                                     {"assessed", false},
                                                     {"filmed", true},
                                                     {"simulated", false},
                                                     {"study", blind},
                                                     {"blind", blind},
                                                     {"trials", 1},
                                                     {"pid", 0}};
  }
  fs::path home() const { return place_ / "home"; }
  fs::path folder() const { return home() / "sessions" / "A1"; }

  palpa::test::ScratchFolder place_;
  palpa::test::ShortFolder sockets_;
};

TEST_F(FilmRoutes, PicturesHaveTheTrialsTimeWithoutItsPauses) {
  Served console(home(), sockets_.path());
  httplib::Client client = console.client();
  const auto answer = client.Get("/api/sessions/A1/trials/1/room");
  ASSERT_EQ(answer->status, 200) << answer->body;
  const json pictures = json::parse(answer->body);
  ASSERT_EQ(pictures.size(), 3u) << "the first is of before the trial: " << pictures;
  EXPECT_NEAR(pictures[0][0].get<double>(), 1, 1e-6);
  EXPECT_NEAR(pictures[1][0].get<double>(), 2, 1e-6) << "in the pause";
  EXPECT_NEAR(pictures[2][0].get<double>(), 2.5, 1e-6);
  for (std::size_t i = 0; i < 3; ++i) {
    const auto picture =
        client.Get("/api/sessions/A1/room/" + pictures[i][1].dump() + "/" + pictures[i][2].dump());
    ASSERT_EQ(picture->status, 200);
    EXPECT_EQ(picture->body, kPictures[i + 1]);
    EXPECT_EQ(picture->get_header_value("Content-Type"), "image/jpeg");
  }
}

TEST_F(FilmRoutes, AFilmMayBeLong) {
  std::ofstream(folder() / "room.mjpeg", std::ios::binary)
      << std::string(1'234'567, '.') << "\xff\xd8late";
  Served console(home(), sockets_.path());
  const auto picture = console.client().Get("/api/sessions/A1/room/1234567/6");
  ASSERT_EQ(picture->status, 200);
  EXPECT_EQ(picture->body, "\xff\xd8late");
}

TEST_F(FilmRoutes, NothingButAPictureCanBeTakenOut) {
  Served console(home(), sockets_.path());
  httplib::Client client = console.client();
  for (const char* path : {"room/1/5", "room/0/0", "room/0/9999999", "room/999999999999/5"})
    EXPECT_EQ(client.Get("/api/sessions/A1/" + std::string(path))->status, 404) << path;
  EXPECT_EQ(json::parse(client.Get("/api/sessions/A1/trials/2/room")->body).size(), 0u);
}

TEST_F(FilmRoutes, ItIsDeletedOnAWishAndNothingElseIs) {
  Served console(home(), sockets_.path());
  EXPECT_EQ(console.post("/api/sessions/A1/room/delete", json::object()), 200);
  EXPECT_FALSE(fs::exists(folder() / "room.mjpeg"));
  EXPECT_FALSE(fs::exists(folder() / "room.mjpeg.csv"));
  EXPECT_EQ(console.get("/api/sessions/A1/trials/1/room").size(), 0u);
  EXPECT_EQ(palpa::test::slurp(folder() / "report.html"), "the report");
  EXPECT_TRUE(fs::exists(folder() / "session.palpa"));
}

// A trainee may withdraw before the first trial, and evidence may be damaged.
TEST_F(FilmRoutes, ItIsFoundAndDeletedWhateverElseIsThere) {
  std::ofstream(folder() / "session.palpa") << "damaged";
  Served console(home(), sockets_.path());
  EXPECT_EQ(console.get("/api/sessions/A1")["film"], true);
  EXPECT_EQ(console.post("/api/sessions/A1/room/delete", json::object()), 200);
  EXPECT_EQ(console.get("/api/sessions/A1")["film"], false);
}

TEST_F(FilmRoutes, WhoIsFilmedIsSaid) {
  Served console(home(), sockets_.path());
  EXPECT_EQ(console.get("/api/sessions/A1")["filmed"], true);
}

TEST_F(FilmRoutes, ABlindStudyShowsNone) {
  describe(true);
  Served console(home(), sockets_.path());
  httplib::Client client = console.client();
  EXPECT_EQ(client.Get("/api/sessions/A1/trials/1/room")->status, 422);
  EXPECT_EQ(client.Get("/api/sessions/A1/room/0/5")->status, 422);
  EXPECT_EQ(console.get("/api/sessions/A1")["film"], false);
}

}  // namespace
}  // namespace palpa::console
