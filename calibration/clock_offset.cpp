#include "calibration/clock_offset.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <optional>

#include "anatomy/base/error.h"
#include "calibration/rotation.h"

namespace palpa::calibration {
namespace {

const char kClock[] = "clock offset";
constexpr std::size_t kLeastCamera = 60, kLeastDevice = 60;
constexpr double kLagStep = 0.005,
                 kSpeedOver = 0.066;  // s: of the search; over which a speed is taken
constexpr double kLeastCorrelation = 0.4, kRival = 0.95;
constexpr double kLeastMotion = 0.01;  // m rms
constexpr double kRoom = 0.05;         // s: so far the fit may move from the start
constexpr double kApart = 0.1;         // s: from one stroke of a motion to another
constexpr double kDecisive = 2;        // how much worse paths must fit at a rival lag

/// A path through samples.
class Path {
 public:
  explicit Path(const std::vector<TimedPoint>& samples) : samples_(samples) {}

  bool covers(double t) const { return t >= samples_[1].t && t < samples_[samples_.size() - 2].t; }

  Vec3 at(double t) const {
    const auto next = std::upper_bound(samples_.begin() + 2, samples_.end() - 1, t,
                                       [](double time, const TimedPoint& s) { return time < s.t; });
    const TimedPoint &b = *(next - 1), &c = *next;
    const TimedPoint &a = *(next - 2), &d = next + 1 < samples_.end() ? *(next + 1) : c;
    const double h = c.t - b.t, u = std::clamp((t - b.t) / h, 0.0, 1.0);
    const Vec3 slope_b = (c.p - a.p) / (c.t - a.t) * h, slope_c = (d.p - b.p) / (d.t - b.t) * h;
    const double u2 = u * u, u3 = u2 * u;
    return (2 * u3 - 3 * u2 + 1) * b.p + (u3 - 2 * u2 + u) * slope_b + (3 * u2 - 2 * u3) * c.p +
           (u3 - u2) * slope_c;
  }

 private:
  const std::vector<TimedPoint>& samples_;
};

void requireSamples(const std::vector<TimedPoint>& samples, std::size_t least, const char* who) {
  const std::string name(who);
  if (samples.size() < least)
    throw Error(std::to_string(samples.size()) + " samples of the " + name + " are too few", kClock,
                "Record ten seconds or more");
  Vec3 mean = Vec3::Zero();
  for (std::size_t i = 0; i < samples.size(); ++i) {
    if (!std::isfinite(samples[i].t) || !samples[i].p.allFinite())
      throw Error("a sample of the " + name + " is not a number", kClock, "Record again");
    if (i > 0 && samples[i].t <= samples[i - 1].t)
      throw Error("the times of the " + name + " run backwards or stand still", kClock,
                  "Sort the samples, and take each once; times are seconds");
    mean += samples[i].p / static_cast<double>(samples.size());
  }
  double squares = 0;
  for (const TimedPoint& s : samples) squares += (s.p - mean).squaredNorm();
  if (std::sqrt(squares / static_cast<double>(samples.size())) < kLeastMotion)
    throw Error("the " + name + " saw hardly any motion (less than 10 mm rms)", kClock,
                "Move the tool by a hand's breadth to and fro, unsteadily; lengths are metres");
}

/// Speeds over kSpeedOver, centred there.
struct Speeds {
  std::vector<double> t, v;
};
Speeds cameraSpeeds(const std::vector<TimedPoint>& camera) {
  Speeds speeds;
  std::size_t from = 0;
  for (std::size_t i = 0; i < camera.size(); ++i) {
    while (camera[i].t - camera[from].t > kSpeedOver + 1e-9 && from + 1 < i) ++from;
    const double h = camera[i].t - camera[from].t;
    if (h < 0.5 * kSpeedOver || h > 2 * kSpeedOver) continue;
    speeds.t.push_back((camera[i].t + camera[from].t) / 2);
    speeds.v.push_back((camera[i].p - camera[from].p).norm() / h);
  }
  return speeds;
}

/// 0 to n - 1 by size.
std::vector<double> ranksOf(const std::vector<double>& values) {
  std::vector<std::size_t> order(values.size());
  for (std::size_t i = 0; i < order.size(); ++i) order[i] = i;
  std::sort(order.begin(), order.end(),
            [&](std::size_t a, std::size_t b) { return values[a] < values[b]; });
  std::vector<double> ranks(values.size());
  for (std::size_t i = 0; i < order.size(); ++i) ranks[order[i]] = static_cast<double>(i);
  return ranks;
}

/// Spearman's: of the ranks, which a few absurd speeds cannot spoil. -2 where too little time is
/// shared.
double correlationAt(const Speeds& camera, const Path& device, double lag) {
  std::vector<double> seen, felt;
  for (std::size_t i = 0; i < camera.t.size(); ++i) {
    const double t = camera.t[i] + lag;
    if (!device.covers(t - kSpeedOver / 2) || !device.covers(t + kSpeedOver / 2)) continue;
    seen.push_back(camera.v[i]);
    felt.push_back((device.at(t + kSpeedOver / 2) - device.at(t - kSpeedOver / 2)).norm());
  }
  const auto n = static_cast<double>(seen.size());
  if (n < 0.4 * static_cast<double>(camera.t.size()) || n < 30) return -2;
  const std::vector<double> a = ranksOf(seen), b = ranksOf(felt);
  double squares = 0;
  for (std::size_t i = 0; i < a.size(); ++i) squares += (a[i] - b[i]) * (a[i] - b[i]);
  return 1 - 6 * squares / (n * (n * n - 1));
}

struct Lag {
  double lag, correlation;
};

/// The best, and hills that are nearly as high: a to and fro fits at other strokes too, as far as
/// speeds tell.
std::vector<Lag> likelyLags(const std::vector<TimedPoint>& camera, const Path& device,
                            double most) {
  const Speeds speeds = cameraSpeeds(camera);
  std::vector<Lag> lags;
  for (double lag = -most; lag <= most + 1e-9; lag += kLagStep)
    lags.push_back({lag, correlationAt(speeds, device, lag)});
  const auto better = [](const Lag& a, const Lag& b) { return a.correlation < b.correlation; };
  const Lag best = *std::max_element(lags.begin(), lags.end(), better);
  if (best.correlation < -1)
    throw Error("the recordings share too little time", kClock,
                "Start both, then move; see that both times are seconds of a like beginning");
  if (best.correlation < kLeastCorrelation) {
    char words[120];
    std::snprintf(
        words, sizeof words,
        "camera and device did not see the same motion (their speeds correlate by %.2f at best)",
        best.correlation);
    throw Error(words, kClock,
                "See that the tag sits on the moving part, and move unsteadily for ten seconds");
  }
  std::vector<Lag> likely{best};
  for (std::size_t i = 1; i + 1 < lags.size(); ++i) {
    const bool hill = lags[i].correlation >= lags[i - 1].correlation &&
                      lags[i].correlation >= lags[i + 1].correlation;
    if (hill && std::abs(lags[i].lag - best.lag) > kApart &&
        lags[i].correlation > kRival * best.correlation)
      likely.push_back(lags[i]);
  }
  return likely;
}

/// The camera's samples that the device's path covers at the lag, with room for the fit to move.
std::vector<TimedPoint> sharedSamples(const std::vector<TimedPoint>& camera, const Path& device,
                                      double lag) {
  std::vector<TimedPoint> shared;
  for (const TimedPoint& s : camera)
    if (device.covers(s.t + lag - kRoom) && device.covers(s.t + lag + kRoom)) shared.push_back(s);
  return shared;
}

/// Offset, drift, R and c; c is where the path's middle is seen, so that turn and shift are nearly
/// independent.
class ClockFit {
 public:
  ClockFit(const std::vector<TimedPoint>& seen, const Path& path, double lag)
      : seen_(seen), path_(path), t_middle_((seen.front().t + seen.back().t) / 2), offset_(lag) {
    overlay();
  }

  Fit run() {
    return robustFit(
        {static_cast<int>(seen_.size()), 3, 8, [this](const VectorX& dx) { return residuals(dx); },
         [this](const VectorX& dx) { move(dx); }},
        kClock);
  }

  double tMiddle() const { return t_middle_; }
  double offset() const { return offset_; }
  double drift() const { return drift_; }
  Pose X_CD() const { return makePose(R_, c_ - R_ * mean_D_); }

 private:
  Vec3 deviceAt(const TimedPoint& s, double offset, double drift) const {
    return path_.at(s.t + offset + drift * (s.t - t_middle_));
  }

  /// The device's path onto the camera's at the start's offset: least squares of both.
  void overlay() {
    const auto n = static_cast<double>(seen_.size());
    for (const TimedPoint& s : seen_) {
      c_ += s.p / n;
      mean_D_ += deviceAt(s, offset_, 0) / n;
    }
    Mat3 cross = Mat3::Zero();
    for (const TimedPoint& s : seen_)
      cross += (s.p - c_) * (deviceAt(s, offset_, 0) - mean_D_).transpose();
    R_ = nearestRotation(cross);
  }

  VectorX residuals(const VectorX& dx) const {
    const Mat3 turned = R_ * rotationOf(dx.segment<3>(2));
    VectorX r(3 * seen_.size());
    for (std::size_t i = 0; i < seen_.size(); ++i)
      r.segment<3>(static_cast<Eigen::Index>(3 * i)) =
          turned * (deviceAt(seen_[i], offset_ + dx[0], drift_ + dx[1]) - mean_D_) + c_ +
          dx.tail<3>() - seen_[i].p;
    return r;
  }

  void move(const VectorX& dx) {
    offset_ += dx[0];
    drift_ += dx[1];
    R_ = R_ * rotationOf(dx.segment<3>(2));
    c_ += dx.tail<3>();
  }

  const std::vector<TimedPoint>& seen_;
  const Path& path_;
  double t_middle_, offset_, drift_ = 0;
  Vec3 c_ = Vec3::Zero(), mean_D_ = Vec3::Zero();
  Mat3 R_ = Mat3::Identity();
};

ClockOffset fittedAt(const Lag& start, const std::vector<TimedPoint>& camera, const Path& path) {
  const std::vector<TimedPoint> seen = sharedSamples(camera, path, start.lag);
  ClockFit clocks(seen, path, start.lag);
  ClockOffset result;
  result.fit = clocks.run();
  if (std::abs(clocks.offset() - start.lag) > 2 * kRoom)
    throw Error("the offset cannot be found", kClock, "Move faster, and record again");
  result.offset = clocks.offset();
  result.drift = clocks.drift();
  result.t_middle = clocks.tMiddle();
  result.correlation = start.correlation;
  result.offset_sd = std::sqrt(result.fit.covariance(0, 0));
  result.drift_sd = std::sqrt(result.fit.covariance(1, 1));
  result.offset_half95 = result.fit.halfWidth95(0);
  result.rms = result.fit.rms;
  result.X_CD = clocks.X_CD();
  return result;
}

/// Nothing where the paths do not fit at all.
std::optional<ClockOffset> rivalAt(const Lag& start, const std::vector<TimedPoint>& camera,
                                   const Path& path) {
  try {
    return fittedAt(start, camera, path);
  } catch (const Error&) {
    return std::nullopt;
  }
}

}  // namespace

ClockOffset estimateClockOffset(const std::vector<TimedPoint>& camera,
                                const std::vector<TimedPoint>& device, double most) {
  requireSamples(camera, kLeastCamera, "camera");
  requireSamples(device, kLeastDevice, "device");
  const Path path(device);
  const std::vector<Lag> likely = likelyLags(camera, path, most);
  if (likely.size() == 1) return fittedAt(likely.front(), camera, path);
  // Speeds say that several would do; the paths in space, which know directions too, decide.
  std::vector<ClockOffset> fits;
  for (const Lag& lag : likely)
    if (const auto fit = rivalAt(lag, camera, path)) fits.push_back(*fit);
  if (fits.empty()) return fittedAt(likely.front(), camera, path);  // says why
  std::sort(fits.begin(), fits.end(),
            [](const ClockOffset& a, const ClockOffset& b) { return a.fit.sigma < b.fit.sigma; });
  for (std::size_t i = 1; i < fits.size(); ++i)
    if (std::abs(fits[i].offset - fits[0].offset) > kApart / 2 &&
        fits[i].fit.sigma < kDecisive * fits[0].fit.sigma)
      throw Error("the motion repeats itself, so that several offsets fit alike", kClock,
                  "Move unsteadily: faster, slower, with stops");
  return fits.front();
}

}  // namespace palpa::calibration
