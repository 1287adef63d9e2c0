#include "apps/twin/setup_bench.h"

#include <cmath>
#include <deque>

#include "anatomy/base/units.h"
#include "anatomy/geometry/random_vector.h"
#include "apps/twin/soft_samples.h"
#include "apps/twin/virtual_camera.h"
#include "calibration/rotation.h"

namespace palpa::twin {
namespace {

using runtime::Request;
constexpr double kStep = 0.001;     // s
constexpr int kStepsAReading = 10;  // 100 Hz
// m, how well a camera tells where a lump is in a clear sample: a tenth of a pixel of 0.2 mm
// [chosen]
constexpr double kSeenLump = 2e-5;
constexpr double kSameLandmark = 1e-4;  // m
constexpr double kBoardTravel = 0.7;    // s from one view to the next
const Vec3 kRestTip_W(0.03, 0.2, 0.12);

double spread(const JsonFile& file, const std::string& at, double otherwise, double most) {
  return file.has(at) ? file.number(at, 0, most) : otherwise;
}

/// The board's middle at a depth at which it takes its share of the picture's width.
Pose boardPose(const runtime::BoardFraming& view, const calibration::CameraModel& camera,
               const ar::TagGridSpec& board, const SetupHandTruth& hand, RandomStream& random) {
  const double depth =
      camera.fx * sheetSize(board).x() / (view.share * camera.width) * (1 + 0.03 * random.normal());
  const Vec3 p_CB(view.across * camera.width / 2 / camera.fx * depth + hand.aim * random.normal(),
                  view.down * camera.height / 2 / camera.fy * depth + hand.aim * random.normal(),
                  depth);
  const Vec3 lean(view.lean + hand.lean * random.normal(), view.turn + hand.lean * random.normal(),
                  hand.lean * random.normal());
  return makePose(calibration::rotationOf(lean) * calibration::halfTurnAboutX(), p_CB);
}

}  // namespace

struct SetupBench::Impl {
  Impl(const station::Station& s, std::uint64_t seed_in)
      : station(s),
        seed(seed_in),
        world(drawWorld(s, seed)),
        device(trueDevice(s, seed)),
        X_CW_boom(cameraOnBoom(s, seed)),
        motion(hand, seed),
        views(seed, "setup.views"),
        holes(seed, "setup.landmarks"),
        imaging(seed, "setup.imaging") {
    const calibration::CameraModel lens = twin::trueCamera(s, seed);
    VirtualScene at_table;
    if (s.marker) at_table.plates = {*s.marker};
    over_table.emplace(lens, s.board, VirtualCameraSettings{}, seed, at_table);
    at_wall.emplace(lens, s.board, VirtualCameraSettings{}, seed,
                    VirtualScene{VirtualScene::Ground::kWall, {s.board}});
    const double off = kMm * spread(s.file, "twin/landmark_spread_mm", 0.1, 10);
    for (const auto* list : {&s.landmarks, &s.grid})
      for (const station::Landmark& landmark : *list)
        holes_W.push_back({landmark.p_W, landmark.p_W + off * normal3(holes)});
    if (s.marker) X_EM = station::readPose(s.file, "twin/X_EM");
    if (s.design.force_sensor && s.design.force_sensor->driver == station::ForceSensorDriver::bench)
      felt.emplace(trueSensor(s, seed), seed);
    X_WT = makePose(calibration::halfTurnAboutX(), kRestTip_W);
    X_CB = makePose(calibration::halfTurnAboutX(), Vec3(0, 0, 0.5));
  }

  /// That sample, untouched so far; its tables are read once.
  void lay(const std::string& name) {
    if (!untouched || untouched_name != name) untouched.emplace(station, name, seed);
    untouched_name = name;
    sample = untouched;
  }

  Vec3 hole(const Vec3& p_W) const {
    for (const auto& [said, truth] : holes_W)
      if ((said - p_W).norm() < kSameLandmark) return truth;
    return p_W;
  }

  Pose X_WE() const { return X_WT * world.X_ET.inverse(); }

  void advance() {
    t += kStep;
    X_WT = motion.step(t, kStep);
    if (sample) touched = sample->step(X_WT, kStep);
    if (showing) X_CB = board_way.at(t);
  }

  haptics::DeviceReading reading() {
    haptics::DeviceReading r;
    const PackedPose X_DE = encoderReading(device, world.X_WD.inverse() * X_WE());
    r.t_ns = std::llround(1e9 * t * (1 + world.clock_drift));
    r.sequence = ++sequence;
    r.p_DE = X_DE.p;
    r.q_DE = X_DE.q;
    r.homed = 1;
    r.buttons = motion.pressing(t) ? runtime::kMarkButton : 0;
    return r;
  }

  runtime::RigMoment readingMoment() {
    runtime::RigMoment moment;
    moment.t = t;
    moment.reading = reading();
    if (felt) {
      const Pose X_WS = X_WE() * station.design.force_sensor->X_ES;
      moment.wrench = felt->measure(X_WS, touched.f_W, touched.p_W, stepsAReading() * kStep,
                                    moment.reading->t_ns);
    }
    if (touched.lump_W) moment.lump_W = *touched.lump_W + kSeenLump * normal3(imaging);
    return moment;
  }

  int stepsAReading() const {
    return sample ? static_cast<int>(1 / (kStep * runtime::kFeltRate_Hz)) : kStepsAReading;
  }

  /// What was before the camera when the shutter opened.
  struct Exposure {
    double t = 0;
    std::uint64_t number = 0;
    bool board_held = false;
    Pose X_CB = Pose::Identity(), X_CM = Pose::Identity();
  };

  void expose() {
    exposures.push_back({t, ++pictures, showing, X_CB, X_CW_boom * X_WE() * X_EM});
    next_exposure += 1 / station.camera_rate_Hz;
  }

  ar::Frame take(const Exposure& e) const {
    std::vector<PlatePose> plates;
    if (e.board_held || station.marker) plates.push_back({0, e.board_held ? e.X_CB : e.X_CM});
    ar::Frame frame;
    frame.number = e.number;
    frame.t_exposure_ns =
        std::llround(1e9 * (e.t + world.camera_latency_s - station.camera_latency_s));
    frame.image = (e.board_held ? *at_wall : *over_table).render(X_CW_boom, plates, e.number);
    frame.source = "virtual camera";
    return frame;
  }

  std::optional<runtime::RigMoment> next() {
    for (;;) {
      if (!exposures.empty() && exposures.front().t + world.camera_latency_s <= t) {
        runtime::RigMoment moment;
        moment.t = t;
        moment.picture = [this, e = exposures.front()]() -> std::optional<ar::Frame> {
          return take(e);
        };
        exposures.pop_front();
        return moment;
      }
      advance();
      if (t >= next_exposure) expose();
      if (++steps % stepsAReading() == 0) return readingMoment();
    }
  }

  const station::Station& station;
  std::uint64_t seed;
  WorldTruth world;
  DeviceTruth device;
  Pose X_CW_boom, X_EM = Pose::Identity();
  SetupHandTruth hand;
  SetupMotion motion;
  RandomStream views, holes;
  std::vector<std::pair<Vec3, Vec3>> holes_W;  ///< where they are said to be, where they are
  std::optional<VirtualCamera> over_table, at_wall;
  std::optional<SensorTwin> felt;
  std::optional<SampleTwin> untouched, sample;  // `sample`: while one is felt
  std::string untouched_name;
  SampleTouch touched;
  RandomStream imaging;
  Pose X_WT = Pose::Identity(), X_CB = Pose::Identity();
  MinJerk board_way;
  bool showing = false;
  double t = 0, next_exposure = 0;
  std::int64_t steps = 0;
  std::uint64_t sequence = 0, pictures = 0;
  std::deque<Exposure> exposures;
};

SetupBench::SetupBench(const station::Station& station, std::uint64_t seed)
    : impl_(std::make_unique<Impl>(station, seed)) {}
SetupBench::~SetupBench() = default;

void SetupBench::ask(const Request& request) {
  Impl& b = *impl_;
  b.showing = request.what == Request::What::show_board;
  if (b.showing) {
    b.board_way = MinJerk(
        b.X_CB, boardPose(request.view, b.over_table->truth(), b.station.board, b.hand, b.views),
        b.t, kBoardTravel);
  }
  b.sample.reset();
  b.touched = {};
  if (request.what == Request::What::press || request.what == Request::What::stroke ||
      request.what == Request::What::palpate)
    b.lay(request.sample);
  b.motion.begin(request, b.X_WT, b.hole(request.p_W), b.t,
                 b.station.sample ? b.station.sample->X_WP : Pose::Identity());
}

std::optional<runtime::RigMoment> SetupBench::next() { return impl_->next(); }
const DeviceTruth& SetupBench::device() const { return impl_->device; }
const WorldTruth& SetupBench::truth() const { return impl_->world; }
const calibration::CameraModel& SetupBench::trueCamera() const {
  return impl_->over_table->truth();
}
Pose SetupBench::X_CW() const { return impl_->X_CW_boom; }

}  // namespace palpa::twin
