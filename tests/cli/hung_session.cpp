#include "hung_session.h"

#include <algorithm>
#include <array>
#include <csignal>
#include <fstream>
#include <nlohmann/json.hpp>
#include <numbers>

#include "anatomy/base/error.h"
#include "apps/os/local_socket.h"
#include "apps/os/socket.h"
#include "apps/os/tcp_socket.h"
#include "apps/record/session_file.h"
#include "apps/runtime/clock.h"
#include "broken_bench.h"
#include "haptics/devices/falcon/falcon_kinematics.h"
#include "tests/computer_faults/falcon_on_a_cable.h"
#include "tests/sensors/fake_net_ft.h"
#include "tests/support/counts.h"

namespace palpa::cli_test {
namespace {

namespace fs = std::filesystem;

const runtime::SteadyClock& testClock() {
  static const runtime::SteadyClock clock;
  return clock;
}

constexpr std::int64_t kPatience = 90 * runtime::kSecond;  // of whoever waits for a step
constexpr double kForce_N = 0.05;

/// Sooner or later.
template <class So>
bool comes(So so, std::int64_t look_ns = 20 * runtime::kMillisecond) {
  for (const std::int64_t end = testClock().now() + kPatience; !so();) {
    if (testClock().now() > end) return false;
    testClock().sleepUntil(testClock().now() + look_ns);
  }
  return true;
}

/// As apps/live/wire.h has it.
std::string frame(char kind, const std::string& body = "") {
  std::string bytes(1, kind);
  for (int shift = 0; shift < 32; shift += 8)
    bytes.push_back(static_cast<char>(body.size() >> shift & 0xff));
  return bytes + body;
}

nlohmann::json stationAsShipped(const std::string& name) {
  return nlohmann::json::parse(contentOf(fs::path(PALPA_SOURCE_DIR) / "assets/stations" / name));
}

/// A quick session: its film, and its hand, which waits until the camera sees: on a busy computer
/// the ready check of whoever replays it takes long.
const Folder& quickRecording() {
  static const Folder here;
  static const bool done = [] {
    nlohmann::json station = stationAsShipped("virtual_bench.json");
    station["camera"]["rate_Hz"] = 5;
    station["twin"]["camera_faults"] = {
        {{"kind", "hidden"}, {"from_s", 0}, {"to_s", test::counted(6, 13)}}};
    here.file("bench.json", station.dump());
    here.file("lens.yml", benchLens());
    return palpa(
               {"subclavian", "--operator", "expert", "--seed", kShortTrial, "--fast", "--no-views",
                "--quiet", "--station", "bench.json", "--record-video", "--out", "A"},
               here.path())
               .exit_code == 0;
  }();
  if (!done) throw std::runtime_error("no session could be recorded");
  return here;
}

Vec3 vectorOf(const nlohmann::json& list) { return unpack(list.get<Packed3>()); }

Mat3 rotationOf(const nlohmann::json& pose) {
  const Vec3 turn = vectorOf(pose["rotation_vector_deg"]) * std::numbers::pi / 180;
  return Eigen::AngleAxisd(turn.norm(), turn.normalized()).toRotationMatrix();
}

/// The Falcon's encoders with the needle's tip so deep below the planned entry, along the needle.
std::array<std::int16_t, 3> encodersAt(double depth_mm) {
  const nlohmann::json station = stationAsShipped("falcon.json");
  const nlohmann::json &D = station["registration"]["X_WD"], &T = station["tool"]["X_ET"];
  const Mat3 R_WD = rotationOf(D);
  const Vec3 axis_W = R_WD * rotationOf(T) * Vec3::UnitZ();
  const Vec3 tip_W = vectorOf(station["patient"]["entry_mm"]) + depth_mm * axis_W;
  const Vec3 grip_D =
      R_WD.transpose() * (tip_W - vectorOf(D["position_mm"])) - vectorOf(T["position_mm"]);
  const Vec3 zero = haptics::falconAngles({0, 0, 0});
  const Vec3 count = haptics::falconAngles({1, 1, 1}) - zero;
  const auto legs = haptics::falconInverse(1e-3 * grip_D);
  std::array<std::int16_t, 3> encoders{};
  for (int leg = 0; legs && leg < 3; ++leg)
    encoders[static_cast<std::size_t>(leg)] =
        static_cast<std::int16_t>(std::lround((legs->theta1[leg] - zero[leg]) / count[leg]));
  return encoders;
}

/// What the device on the cable is told by its file, and tells by it.
test::FalconWorld worldIn(const fs::path& file) {
  test::FalconWorld world{};
  std::ifstream(file, std::ios::binary).read(reinterpret_cast<char*>(&world), sizeof world);
  return world;
}
bool pushes(const test::FalconWorld& world) {
  return world.motor[0] || world.motor[1] || world.motor[2];
}
void holdGrip(const fs::path& file, double depth_mm) {
  const auto encoders = encodersAt(depth_mm);
  std::fstream(file, std::ios::binary | std::ios::in | std::ios::out)
      .write(reinterpret_cast<const char*>(encoders.data()), sizeof encoders);
}

}  // namespace

HungSession::HungSession(HungPart hung) : part(std::move(hung)), device_(part.calls == "usb") {
  if (part.calls == "datagram") sensor_ = std::make_unique<haptics::FakeNetFt>();
  if (!device_) return;
  folder.file("falcon", std::string(sizeof(test::FalconWorld), '\0'));
  holdGrip(folder / "falcon", -10);
}

HungSession::~HungSession() = default;

std::string HungSession::station(const std::string& shipped) const {
  nlohmann::json station = stationAsShipped(shipped);
  station["camera"]["rate_Hz"] = 3;
  if (sensor_) {
    station["device"]["driver"] = "replay";
    station["device"]["recording"] = (quickRecording() / "A/session.palpa").string();
    station["force_sensor"] = BrokenBench::netFtAt(sensor_->port());
  }
  return folder.file("station.json", station.dump());
}

std::vector<std::string> HungSession::arguments() {
  std::vector<std::string> all{"subclavian", "--quiet", "--record-video", "--live",    "s",
                               "--out",      "A",       "--seed",         kShortTrial, "--station"};
  const auto add = [&all](const std::vector<std::string>& more) {
    all.insert(all.end(), more.begin(), more.end());
  };
  add({station(device_ ? "falcon.json" : "virtual_bench.json")});
  if (device_)
    add({"--operator", "person", "--display", "openxr", "--no-familiarisation"});
  else
    add({"--no-views"});
  if (!device_ && !sensor_) add({"--operator", "expert", "--trials", "9"});
  if (part.calls == "stream")
    add({"--igtl", std::to_string(os::TcpListener("127.0.0.1", 0).port())});
  if (part.calls == "film")
    add({"--camera", quickRecording() / "A/camera.mjpeg", "--intrinsics",
         quickRecording() / "lens.yml", "--board", "tags:6x4:0.030:0.0075"});
  return all;
}

Environment HungSession::environment() const {
  Environment all{{"LD_PRELOAD", PALPA_TEST_FAULTS}, {"PALPA_HANG", folder / "hang"}};
  if (!device_) return all;
  all.emplace_back("PALPA_FALCON", folder / "falcon");
  all.emplace_back("XR_RUNTIME_JSON", PALPA_TEST_XR_JSON);
  all.emplace_back("PALPA_TEST_XR", "eyes=32x32,32x32;rate=2");
  return all;
}

/// What the evidence holds now; nothing before it says what it is.
std::vector<haptics::FlightRecord> HungSession::ticks() const {
  std::vector<haptics::FlightRecord> all;
  try {
    if (fs::exists(folder / "A/session.palpa"))
      record::SessionReader(folder / "A/session.palpa")
          .ticks([&](const haptics::FlightRecord& tick) { all.push_back(tick); });
  } catch (const Error&) {
  }
  return all;
}

/// Shortly ago.
bool HungSession::feelsForce() {
  constexpr std::ptrdiff_t kShortly = 200;
  const auto all = ticks();
  const auto shortly = std::min<std::ptrdiff_t>(kShortly, std::ssize(all));
  const auto end = all.rbegin() + shortly;
  const auto tick = std::find_if(all.rbegin(), end, [](const haptics::FlightRecord& one) {
    return unpack(one.f_command_D).norm() > kForce_N;
  });
  if (tick != end) felt_ns = tick->t_ns;
  return tick != end;
}

/// By the console's socket, as its page's button does.
void HungSession::commandStart() {
  const int socket = os::connectTo(folder / "s");
  const std::string command = frame('C', R"({"command": "start"})");
  os::sendSome(socket, command.data(), command.size());
  testClock().sleepUntil(testClock().now() + 200 * runtime::kMillisecond);
  os::closeSocket(socket);
}

/// A person's hand: until there is force. The evidence may be behind what it does.
bool HungSession::pushesTheGrip() {
  constexpr double kDeepest_mm = 12;
  for (double depth_mm = -10; depth_mm < kDeepest_mm; depth_mm += 0.5) {
    if (depth_mm > 0 && feelsForce()) return true;
    holdGrip(folder / "falcon", depth_mm);
    testClock().sleepUntil(testClock().now() + (depth_mm < 0 ? 20 : 150) * runtime::kMillisecond);
  }
  return comes([this] { return program_->ended() || feelsForce(); }) && !program_->ended();
}

bool HungSession::waitFor(const char* step, bool came) {
  if (came || !trouble.empty()) return came;
  trouble = std::string(step) + " did not come";
  if (program_->ended())
    trouble += "; the program has ended with " + std::to_string(program_->exitCode());
  return false;
}

bool HungSession::begins() {
  program_ = std::make_unique<Running>(arguments(), folder.path(), folder / "err", environment());
  const auto armed = [this] {
    const auto all = ticks();
    return !all.empty() && all.back().commands.armed;
  };
  if (!device_)
    return waitFor("force", comes([this] { return program_->ended() || feelsForce(); },
                                  300 * runtime::kMillisecond) &&
                                !program_->ended());
  if (!waitFor("the console's socket", comes([this] { return fs::exists(folder / "s"); })))
    return false;
  const bool started = comes([&] { return program_->ended() || (commandStart(), armed()); });
  if (!waitFor("a trial", started) || !waitFor("force", pushesTheGrip())) return false;
  device_pushed = pushes(worldIn(folder / "falcon"));
  return true;
}

bool HungSession::hangs() {
  folder.file("hang", part.calls + "\n");
  return waitFor("the hang", comes([this] { return fs::exists(folder / "hang.reached"); }));
}

bool HungSession::isStopped() {
  const int socket = os::connectTo((folder / "s").string() + "!");
  const std::string stop = frame('S');
  char answer[64];
  const bool confirmed = socket >= 0 && os::sendSome(socket, stop.data(), stop.size()) &&
                         os::ready(socket, os::Wait::to_read, 30'000) &&
                         os::receiveSome(socket, answer, sizeof answer) == stop.size();
  confirmed_ns = testClock().now();
  if (socket >= 0) os::closeSocket(socket);
  return waitFor("the stop's confirmation", confirmed);
}

/// Whether the evidence tells, by now, that the hung part does this.
bool HungSession::tells(const std::string& what) const {
  try {
    const auto events = record::SessionReader(folder / "A/session.palpa").events();
    return std::any_of(events.begin(), events.end(), [&](const runtime::Event& event) {
      return says(event.text, part.words + ' ' + what);
    });
  } catch (const Error&) {
    return false;
  }
}

bool HungSession::isTold(const std::string& what) {
  const auto told = [&] { return tells(what) || program_->ended(); };
  return waitFor(("that it " + what).c_str(),
                 comes(told, 200 * runtime::kMillisecond) && !program_->ended());
}

/// It is silent for a while, is let go where that is to be, and all of it is told. The evidence
/// tells nothing while itself hangs.
bool HungSession::isSilentForAWhile() {
  const std::int64_t hang = test::counted(5, 60) * runtime::kSecond;
  const bool let_go = part.how_long == Hangs::for_a_while, is_evidence = part.calls == "evidence";
  testClock().sleepUntil(testClock().now() + (let_go ? hang : 4 * runtime::kSecond));
  if (!is_evidence && !isTold("does not answer")) return false;
  if (!let_go) return true;
  fs::remove(folder / "hang");
  return isTold("does not answer") && isTold("answers again");
}

bool HungSession::ends() {
  const bool let_go = part.how_long == Hangs::for_a_while;
  if (!isSilentForAWhile()) return false;
  asked_ns = testClock().now();
  program_->send(SIGTERM);
  const auto saysSo = [this] {
    return says(contentOf(folder / "err"), "left behind") || program_->ended();
  };
  if (part.calls == "evidence" && !let_go) {  // nothing can be read or written meanwhile
    if (!waitFor("that it is left behind", comes(saysSo))) return false;
    fs::remove(folder / "hang");
  }
  if (!waitFor("the end", comes([this] { return program_->ended(); }))) return false;
  exit_code = program_->exitCode();
  err = contentOf(folder / "err");
  fs::remove(folder / "hang");
  if (device_) device_let_go = comes([this] { return !pushes(worldIn(folder / "falcon")); });
  return true;
}

void HungSession::run() {
  try {
    begins() && hangs() && isStopped() && ends();
  } catch (const std::exception& e) {
    trouble = e.what();
  }
}

}  // namespace palpa::cli_test
