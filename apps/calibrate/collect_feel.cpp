#include "apps/calibrate/collect.h"

#include <algorithm>
#include <cmath>

#include "anatomy/base/error.h"
#include "apps/calibrate/learnt_object.h"
#include "apps/calibrate/recorded.h"
#include "calibration/touch/contact_laws.h"
#include "haptics/sensors/wrench_filter.h"

namespace palpa::calibrate {
namespace {

using runtime::Request;
using runtime::RigMoment;
constexpr double kCutOff_Hz = 30, kFeltDeep = 7e-3, kStrokeReach = 0.02;  // m
constexpr std::size_t kShownEvery = 250;                                  // readings
constexpr std::size_t kShownColumns = 24;
constexpr double kEvenWithin = 0.5;     // of dt
constexpr std::size_t kLiveEvery = 40;  // readings

void requireSample(const station::Station& station) {
  if (!station.force_sensor)
    throw UsageError("has no \"force_sensor\"", station.file.name(),
                     "A sample's material is identified by its forces: describe the sensor");
  if (!station.sample)
    throw UsageError("has no \"sample\"", station.file.name(),
                     "Say where it lies: sample/X_WP, sample/tip_radius_mm");
}

/// A small picture of a stretch of figures, in a line of text.
std::string sparks(const std::vector<double>& values, double most) {
  static const char* const kHeights[] = {"▁", "▂", "▃", "▄", "▅", "▆", "▇", "█"};
  std::string line;
  for (const double v : values)
    line += kHeights[std::clamp(static_cast<int>(8 * v / std::max(most, 1e-9)), 0, 7)];
  return line;
}

/// Live: what was felt in the last second or so, beside what the law so far predicts.
class LivePlot {
 public:
  void add(const FeltSample& sample, double dt) {
    const double x = -sample.p_P.z(), rate = before_ ? (x - *before_) / dt : 0;
    before_ = x;
    estimator_.add({x, rate, sample.f_P.z()});
    if (++count_ % kLiveEvery != 0) return;
    felt_.push_back(std::max(sample.f_P.z(), 0.0));
    predicted_.push_back(haptics::forceOf(estimator_.law(), x, rate));
    if (felt_.size() > kShownColumns) {
      felt_.erase(felt_.begin());
      predicted_.erase(predicted_.begin());
    }
  }
  std::string words() const {
    if (felt_.empty()) return "";
    const double most = std::max(*std::max_element(felt_.begin(), felt_.end()),
                                 *std::max_element(predicted_.begin(), predicted_.end()));
    return "felt " + sparks(felt_, most) + " predicted " + sparks(predicted_, most);
  }

 private:
  calibration::PressEstimator estimator_;
  std::optional<double> before_;
  std::size_t count_ = 0;
  std::vector<double> felt_, predicted_;
};

/// Reading and wrench as a touch of the sample.
class Feeling {
 public:
  explicit Feeling(const station::Station& station)
      : station_(station),
        radius_(station.sample->tip_radius),
        X_PW_(station.sample->X_WP.inverse()) {
    filter_.tool = station.force_sensor->tool;
    filter_.bias = station.force_sensor->bias;
    filter_.motion.rate_Hz = runtime::kFeltRate_Hz;
    filter_.low_pass = haptics::butterworth(kCutOff_Hz, runtime::kFeltRate_Hz);
    filter_.p_SK =
        pack(Vec3(station.force_sensor->X_ES.inverse() * (station.X_ET * Vec3(0, 0, -radius_))));
  }
  std::optional<FeltSample> feel(const RigMoment& moment) {
    const Pose X_WS = station_.X_WD * poseOf(*moment.reading) * station_.force_sensor->X_ES;
    haptics::WrenchSample silent;
    silent.flags = haptics::kNothingYet;
    const haptics::ContactWrench told = haptics::step(
        filter_, state_, moment.wrench ? *moment.wrench : silent, pack(X_WS), moment.reading->t_ns);
    if (!told.valid) return std::nullopt;
    FeltSample sample;
    sample.p_P = X_PW_ * unpack(told.p_WK) - radius_ * Vec3::UnitZ();
    sample.f_P = X_PW_.linear() * (X_WS.linear() * unpack(told.contact.f_S));
    if (moment.lump_W) sample.lump_P = late(X_PW_.linear() * *moment.lump_W);
    return sample;
  }

 private:
  /// As late as force and place are.
  Vec3 late(const Vec3& d) {
    const Packed3 before = lump_before_ ? *lump_before_ : pack(d);
    if (!lump_before_) haptics::settle(filter_.low_pass, lump_, before);
    lump_before_ = pack(d);
    return unpack(haptics::apply(filter_.low_pass, lump_, before));
  }

  const station::Station& station_;
  haptics::WrenchFilter filter_;
  haptics::WrenchFilterState state_;
  haptics::LowPassState<3> lump_;
  std::optional<Packed3> lump_before_;
  double radius_;
  Pose X_PW_;
};

struct FeltTimes {
  double asked = -1, ended = 0;  ///< s of the rig's clock
};
/// While the button is held, from where the sensor's word can be used.
FeltSamples collectFelt(const Scene& scene, const Request& request, FeltTimes* times = nullptr) {
  scene.guide.ask(request.words);
  scene.rig.ask(request);
  const auto wanted = static_cast<std::size_t>(request.seconds * runtime::kFeltRate_Hz);
  Feeling feeling(scene.station);
  LivePlot live;
  FeltSamples felt;
  double begun = -1, silent_since = -1;
  while (felt.samples.size() < wanted) {
    const RigMoment moment = need(scene.rig, "calibration of a sample");
    if (begun < 0) begun = moment.t;
    if (times) times->ended = moment.t;
    if (times && times->asked < 0) times->asked = moment.t;
    if (!moment.reading) continue;
    const std::optional<FeltSample> sample = feeling.feel(moment);
    if (!pressed(*moment.reading)) {
      if (moment.t - begun > kPatience && felt.samples.empty())
        throw Error("nobody pressed the button for a minute", request.words,
                    "Begin again when somebody is at the device");
      if (!felt.samples.empty()) break;
      continue;
    }
    if (!sample) {
      if (silent_since < 0) silent_since = moment.t;
      if (moment.t - silent_since > 1)
        throw Error("gives no reading that can be used", "force sensor",
                    "Look at its cable; is it overloaded?");
      felt.samples.clear();  // after a gap the times would not be even
      continue;
    }
    silent_since = -1;
    felt.samples.push_back(*sample);
    live.add(*sample, felt.dt);
    if (felt.samples.size() % kShownEvery == 0 || felt.samples.size() == wanted)
      scene.guide.progress("Samples", static_cast<int>(felt.samples.size()),
                           static_cast<int>(wanted), live.words());
  }
  return felt;
}

}  // namespace

FeltSamples collectPresses(const Scene& scene, const std::string& sample, const FeltPlace& place,
                           double seconds) {
  requireSample(scene.station);
  Request request;
  request.what = Request::What::press;
  request.sample = sample;
  request.depth = kFeltDeep;
  request.p_W = scene.station.sample->X_WP * Vec3(place.across, place.along, 0);
  request.seconds = seconds;
  request.words =
      "Hold the button and press the sample with the upright tip, 7 mm deep at most, and let go: "
      "slowly and quickly, for " +
      std::to_string(static_cast<int>(seconds)) + " s";
  return collectFelt(scene, request);
}

FeltSamples collectStrokes(const Scene& scene, const std::string& sample, double seconds) {
  requireSample(scene.station);
  Request request;
  request.what = Request::What::stroke;
  request.sample = sample;
  request.depth = kFeltDeep;
  request.reach = kStrokeReach;
  request.p_W = scene.station.sample->X_WP.translation();
  request.seconds = seconds;
  request.words =
      "Hold the button and stroke over the sample, to and fro, lightly and firmly, slowly and "
      "fast, for " +
      std::to_string(static_cast<int>(seconds)) + " s";
  return collectFelt(scene, request);
}

namespace {

/// In rows, closer together toward the rim (as Chebyshev's points): beyond the last touches nothing
/// tells what a thing is like, and at its rim it changes most.
std::vector<Eigen::Vector2d> rowsOver(const calibration::MappedArea& area) {
  constexpr int kEach = 7;
  constexpr double kLast = 1.35;  // rad: the outermost at 0.98 of the way
  const auto at = [](int i) { return std::sin(kLast * (2.0 * i / (kEach - 1) - 1)); };
  std::vector<Eigen::Vector2d> places;
  const Eigen::Vector2d middle = (area.high + area.low) / 2, half = (area.high - area.low) / 2;
  for (int j = 0; j < kEach; ++j)
    for (int i = 0; i < kEach; ++i)
      places.push_back(
          middle + half.cwiseProduct(Eigen::Vector2d(at(j % 2 == 0 ? i : kEach - 1 - i), at(j))));
  return places;
}

/// A few of the first touches are held long: nothing else tells what relaxes slowly.
bool heldLong(std::size_t touch) {
  constexpr std::size_t kLongOnes = 4, kEvery = 8;
  return touch % kEvery == kEvery / 2 && touch < kLongOnes * kEvery;
}

Request touchAt(const Scene& scene, const std::string& sample, const Eigen::Vector2d& p,
                bool held_long) {
  constexpr double kDeep = 4.5e-3, kSlide = 0.01, kLongest_s = 8, kHeld_s = 3;
  Request request;
  request.what = Request::What::palpate;
  request.sample = sample;
  request.depth = kDeep;
  request.reach = kSlide;
  request.p_W = scene.station.sample->X_WP * Vec3(p.x(), p.y(), 0);
  request.seconds = kLongest_s;
  request.holds = held_long ? kHeld_s : 0;
  request.words = "Hold the button and press at " + quantity(1e3 * p.x(), "mm") + " across, " +
                  quantity(1e3 * p.y(), "mm") + " along from the middle, 4 mm deep; " +
                  (held_long ? "hold for 3 s" : "hold for a moment") + ", slide 10 mm, lift";
  return request;
}

}  // namespace

ObjectTouches collectObject(const Scene& scene, const std::string& sample,
                            const calibration::MappedArea& area, double seconds) {
  constexpr int kAdvised = 6;  // places at a time
  requireSample(scene.station);
  ObjectTouches all;
  FeltTimes times;
  std::vector<Eigen::Vector2d> next = rowsOver(area);
  for (;;) {
    for (const Eigen::Vector2d& p : next) {
      all.touches.push_back(
          collectFelt(scene, touchAt(scene, sample, p, heldLong(all.touches.size())), &times));
      all.seconds = times.ended - times.asked;
      scene.guide.progress("Seconds", static_cast<int>(std::min(all.seconds, seconds)),
                           static_cast<int>(seconds), "");
      if (all.seconds >= seconds) return all;
    }
    const calibration::MapVerdict verdict =
        judge(learnObject(all.touches).stiffness, area, kAdvised);
    if (verdict.sure) return all;
    next = verdict.next;
  }
}

FeltSamples readFelt(const std::filesystem::path& file) {
  const SampleTable table(file);
  if (table.rows() < 2)
    throw Error("holds fewer than two samples", file.string(), "Record for longer");
  FeltSamples felt;
  felt.dt = (table.number(table.rows() - 1, "t_s") - table.number(0, "t_s")) /
            static_cast<double>(table.rows() - 1);
  if (!(felt.dt > 1e-5 && felt.dt < 0.1))
    throw Error("has times that do not rise by 0.01 to 100 ms", file.string(),
                "Give t_s in seconds");
  const bool lump = table.has("lump_x_mm") || table.has("lump_x_m");
  for (std::size_t i = 0; i < table.rows(); ++i) {
    if (i > 0 && std::abs(table.number(i, "t_s") - table.number(i - 1, "t_s") - felt.dt) >
                     kEvenWithin * felt.dt)
      throw Error("has times that are not even (row " + std::to_string(i + 1) + ")", file.string(),
                  "Record at an even rate, without gaps");
    FeltSample sample{table.place(i, ""),
                      Vec3(table.number(i, "force_x_N"), table.number(i, "force_y_N"),
                           table.number(i, "force_z_N")),
                      std::nullopt};
    if (lump) sample.lump_P = table.place(i, "lump_");
    felt.samples.push_back(sample);
  }
  return felt;
}

}  // namespace palpa::calibrate
