#include <gtest/gtest.h>
#include <poll.h>

#include <functional>
#include <map>
#include <nlohmann/json.hpp>
#include <optional>
#include <thread>

#include "apps/link/igtl/conventions.h"
#include "apps/os/tcp_socket.h"
#include "apps/record/session_file.h"
#include "program.h"
#include "tests/igtl/library_peer.h"

/// Whole sessions that are listened to by OpenIGTLink, and one whose camera's place a tracking
/// system tells.
namespace palpa::cli_test {
namespace {

using igt_test::Got;
using igt_test::LibraryClient;

std::uint16_t freePort() { return os::TcpListener("127.0.0.1", 0).port(); }

/// As soon as somebody serves there; gives up after 20 s.
std::unique_ptr<LibraryClient> connectWhenThere(std::uint16_t port) {
  for (int i = 0; i < 400; ++i) {
    os::TcpSocket probe = os::TcpSocket::connecting("127.0.0.1", port);
    if (probe.connected(50) == os::TcpSocket::Progress::done)
      return std::make_unique<LibraryClient>(port);
    poll(nullptr, 0, 50);
  }
  return nullptr;
}

Pose poseOf(const nlohmann::json& X) {
  return unpack(PackedPose{X.at("p_m").get<Packed3>(), X.at("q_wxyz").get<Packed4>()});
}

/// What a file recorded, by session time.
struct WrittenDown {
  std::map<std::int64_t, haptics::FlightRecord> ticks;
  std::vector<runtime::Event> events;
  Pose X_WD;
  explicit WrittenDown(const std::filesystem::path& file) {
    const record::SessionReader reader(file);
    reader.ticks([&](const haptics::FlightRecord& tick) { ticks[tick.t_ns] = tick; });
    events = reader.events();
    X_WD = poseOf(nlohmann::json::parse(reader.info().session_json).at("X_WD"));
  }
  const haptics::FlightRecord* at(std::int64_t t_ns) const {
    const auto tick = ticks.lower_bound(t_ns - 100);  // the library's fractions are good to some ns
    return tick != ticks.end() && tick->first <= t_ns + 100 ? &tick->second : nullptr;
  }
};

nlohmann::json eventOf(const Got& message) { return nlohmann::json::parse(message.text); }

/// UTC of session time 0, by the first event that was heard.
std::int64_t startOf(const std::vector<Got>& heard, const WrittenDown& recorded) {
  for (const Got& m : heard) {
    if (m.device != "PalpaEvent") continue;
    const nlohmann::json told = eventOf(m);
    for (const runtime::Event& event : recorded.events)
      if (told.at("kind") == event.kind && told.at("text") == event.text)
        return m.utc_ns - event.t_ns;
  }
  return 0;
}

void expectAsRecorded(const std::vector<Got>& heard, const WrittenDown& recorded) {
  const std::int64_t start_ns = startOf(heard, recorded);
  ASSERT_NE(start_ns, 0) << "no event was heard";
  int poses = 0, forces = 0;
  for (const Got& m : heard) {
    ASSERT_TRUE(m.whole) << m.device;
    const haptics::FlightRecord* tick = recorded.at(m.utc_ns - start_ns);
    if (m.device == "NeedleToReference") {
      ASSERT_TRUE(tick) << m.utc_ns - start_ns << " ns: no tick was then";
      const Pose X_WE = recorded.X_WD * unpack(PackedPose{tick->reading.p_DE, tick->reading.q_DE});
      EXPECT_LT((m.X_mm - igt::toWire(X_WE)).cwiseAbs().maxCoeff(), 1e-3)
          << "mm, at " << tick->tick;
      ++poses;
    } else if (m.device == "NeedleDeviceForce") {
      ASSERT_TRUE(tick);
      const Vec3 f_W = recorded.X_WD.linear() * unpack(tick->f_command_D);
      EXPECT_NEAR((Vec3(m.values.at(0), m.values.at(1), m.values.at(2)) - f_W).norm(), 0, 1e-9);
      ++forces;
    }
  }
  EXPECT_GT(poses, 50);
  EXPECT_GT(forces, 50);
}

TEST(Igtl, WhatIsToldIsWhatIsRecordedAndListeningChangesNothing) {
  Folder here;
  const std::uint16_t port = freePort();
  std::vector<Got> heard;
  std::thread slicer([&] {
    const auto client = connectWhenThere(port);
    while (auto got = client ? client->next(5000) : std::nullopt) heard.push_back(std::move(*got));
  });
  const Outcome told = palpa(
      session({"--seed", kShortTrial, "--out", "A", "--igtl", std::to_string(port)}), here.path());
  slicer.join();
  ASSERT_EQ(told.exit_code, 0) << told.err;
  const WrittenDown recorded(here / "A/session.palpa");
  expectAsRecorded(heard, recorded);
  ASSERT_TRUE(igt_test::lastOf(heard, "PalpaEvent"));
  EXPECT_EQ(eventOf(*igt_test::lastOf(heard, "PalpaEvent")).at("kind"), "trial_end")
      << "what is recorded last is told as well";
  EXPECT_TRUE(says(contentOf(here / "A/report.html"), "Listeners by OpenIGTLink"));
  const Outcome alone = palpa(session({"--seed", kShortTrial, "--out", "B"}), here.path());
  ASSERT_EQ(alone.exit_code, 0) << alone.err;
  EXPECT_EQ(contentOf(here / "A/trials.csv"), contentOf(here / "B/trials.csv"));
}

TEST(Igtl, WrongPortsAndAddressesAreToldInOneLine) {
  Folder here;
  const os::TcpListener taken("127.0.0.1", 0);
  const Outcome held =
      palpa(session({"--igtl", std::to_string(taken.port()), "--out", "A"}), here.path());
  EXPECT_EQ(held.exit_code, 1);
  EXPECT_EQ(held.errLines(), 1) << held.err;
  EXPECT_TRUE(says(held.err, "another port")) << held.err;
  EXPECT_FALSE(std::filesystem::exists(here / "A/session.palpa")) << "nothing was begun";
  for (const std::vector<std::string>& wrong : {std::vector<std::string>{"--igtl", "0"},
                                                {"--igtl", "70000"},
                                                {"--igtl-listen", "127.0.0.1"},
                                                {"--igtl", "18945", "--igtl-listen", "here"}}) {
    std::vector<std::string> arguments = wrong;
    arguments.insert(arguments.end(), {"--out", "B"});
    const Outcome outcome = palpa(session(arguments), here.path());
    EXPECT_EQ(outcome.exit_code, 2) << wrong[0] << " " << wrong[1];
    EXPECT_EQ(outcome.errLines(), 1) << outcome.err;
  }
}

std::string stationWithTracker(int port, const std::string& transform = "ReferenceToCamera") {
  nlohmann::json station = nlohmann::json::parse(contentOf(quickStation("virtual_bench.json")));
  const nlohmann::json nowhere{{"position_mm", {0, 0, 0}}, {"rotation_vector_deg", {0, 0, 0}}};
  station["tracker"] = {{"driver", "plus"},
                        {"host", "127.0.0.1"},
                        {"port", port},
                        {"transform", transform},
                        {"X_CK", {{"position_mm", {10, 0, 0}}, {"rotation_vector_deg", {0, 0, 0}}}},
                        {"X_RW", nowhere}};
  return station.dump();
}

/// A session whose camera's place this PLUS server tells; what it says is heard.
class Followed {
 public:
  Followed() {
    here_.file("station.json", stationWithTracker(plus.port()));
    run_.emplace(std::vector<std::string>{"subclavian", "--station", "station.json", "--operator",
                                          "expert", "--no-views", "--quiet", "--out", "A", "--igtl",
                                          std::to_string(port_)},
                 here_.path());
  }
  bool begins() { return plus.accept(60'000) && (client_ = connectWhenThere(port_)); }
  /// Sends, if it is to, and listens until `done` is said; nothing after 20 s.
  std::optional<Got> hears(bool sending, const std::function<bool(const Got&)>& done) {
    for (int i = 0; i < 1000; ++i) {
      if (sending) plus.send(igt::transformMessage("ReferenceToCamera", igt::toWire(X_KR), 0));
      for (auto got = client_->next(20); got; got = client_->next(0))
        if (done(*got)) return got;
    }
    return std::nullopt;
  }
  std::optional<Got> hearsEvent(bool sending, const std::string& kind, double value) {
    return hears(sending, [&](const Got& got) {
      return got.device == "PalpaEvent" && eventOf(got).at("kind") == kind &&
             eventOf(got).at("value") == value;
    });
  }
  /// Ends it as Ctrl-C does; its page.
  std::string ended() {
    EXPECT_EQ(run_->interrupt(), 0);
    return contentOf(here_ / "A/report.html");
  }

  igt_test::LibraryServer plus;
  const Pose X_KR =
      makePose(Eigen::AngleAxisd(3, Vec3::UnitX()).toRotationMatrix(), Vec3(0.03, -0.02, 0.5));

 private:
  Folder here_;
  const std::uint16_t port_ = freePort();
  std::optional<Running> run_;
  std::unique_ptr<LibraryClient> client_;
};

TEST(Igtl, CameraIsWhereTheTrackingSystemSaysUntilItIsLost) {
  Followed session;
  ASSERT_TRUE(session.begins());
  ASSERT_TRUE(session.hearsEvent(true, "ready", 0))
      << "the tracking system's word is enough for the ready check";
  const auto toldCamera = [](const Got& got) { return got.device == "CameraToReference"; };
  const auto camera = session.hears(true, toldCamera);
  ASSERT_TRUE(camera);
  const Pose X_CW = makePose(Mat3::Identity(), Vec3(0.01, 0, 0)) * session.X_KR;
  EXPECT_LT((camera->X_mm - igt::toWire(X_CW.inverse())).cwiseAbs().maxCoeff(), 0.1);

  session.plus.hangUp();
  const auto lost = session.hearsEvent(false, "camera", 1);
  ASSERT_TRUE(lost) << "the session says that tracking is lost";
  EXPECT_TRUE(says(eventOf(*lost).at("text"), "tracking system has lost")) << lost->text;

  ASSERT_TRUE(session.plus.accept(10'000)) << "the session tries again";
  session.plus.send(igt::Bytes(3000, 0x5a));  // a server that sends nonsense is left
  ASSERT_TRUE(session.plus.accept(10'000)) << "and again";
  ASSERT_TRUE(session.hearsEvent(true, "camera", 0)) << "it is found again";
  ASSERT_TRUE(session.hears(true, toldCamera));
  const std::string page = session.ended();
  EXPECT_TRUE(says(page, "Poses of the tracking system"));
  EXPECT_TRUE(says(page, "connected 3 times"));
}

TEST(Igtl, TrackersOfAStationAreChecked) {
  Folder here;
  here.file("station.json", stationWithTracker(18944));
  here.file("nameless.json", stationWithTracker(18944, "Camera"));
  const Outcome fast = palpa(session({"--station", "station.json", "--out", "A"}), here.path());
  EXPECT_EQ(fast.exit_code, 2);
  EXPECT_TRUE(says(fast.err, "real time")) << fast.err;
  const Outcome nameless =
      palpa(session({"--station", "nameless.json", "--out", "A"}), here.path());
  EXPECT_EQ(nameless.exit_code, 2);
  EXPECT_TRUE(says(nameless.err, "tracker/transform")) << nameless.err;
}

}  // namespace
}  // namespace palpa::cli_test
