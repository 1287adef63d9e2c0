#include "calibration/touch/contact_laws.h"

#include <algorithm>
#include <cmath>

#include "anatomy/base/error.h"
#include "anatomy/geometry/dense_solvers.h"

namespace palpa::calibration {
namespace {

using haptics::Dahl;
constexpr char kFrictionWhere[] = "friction identification";
constexpr std::size_t kLeastSlides = 200, kLeastStrokes = 4;
constexpr double kSameWay =
    0.5;  // cosine: a stroke goes on while its motion turns by less than 60 degrees
constexpr double kSlidFar = 3;  // in units of F_c / sigma: 95 % of Coulomb's friction
constexpr double kNoStep = 1e-9;

/// A sample in its stroke: the way since the stroke began, and what is dragged along it.
struct Along {
  double way = 0, speed = 0, f_n = 0, drag = 0;
};
using Stroke = std::vector<Along>;

Vec3 inPlane(const Vec3& v, const Vec3& n) { return v - v.dot(n) * n; }

void requireNumbers(const std::vector<SlideSample>& samples, double dt) {
  if (samples.size() < kLeastSlides)
    throw Error(std::to_string(samples.size()) + " samples are too few, " +
                    std::to_string(kLeastSlides) + " are needed",
                kFrictionWhere, "Stroke for longer");
  bool good = dt > 0;
  for (const SlideSample& s : samples)
    good = good && s.p.allFinite() && s.drag.allFinite() && std::isfinite(s.f_n) &&
           std::abs(s.n.norm() - 1) < 1e-6;
  if (!good)
    throw Error("a sample is not a number, or a normal is not of length 1", kFrictionWhere,
                "Record again");
}

std::vector<Stroke> strokesOf(const std::vector<SlideSample>& samples, double dt) {
  std::vector<Stroke> strokes;
  Vec3 before = Vec3::Zero();
  for (std::size_t i = 1; i < samples.size(); ++i) {
    const SlideSample& s = samples[i];
    const Vec3 dp = inPlane(s.p - samples[i - 1].p, s.n);
    const double step = dp.norm();
    if (s.f_n <= 0 || step < kNoStep) continue;
    const Vec3 way = dp / step;
    if (strokes.empty() || samples[i - 1].f_n <= 0 || way.dot(before) < kSameWay)
      strokes.emplace_back();
    Stroke& stroke = strokes.back();
    stroke.push_back(
        {(stroke.empty() ? 0 : stroke.back().way) + step, step / dt, s.f_n, s.drag.dot(way)});
    before = way;
  }
  double longest = 0;
  for (const Stroke& stroke : strokes) longest = std::max(longest, stroke.back().way);
  std::erase_if(strokes, [&](const Stroke& stroke) { return stroke.back().way < 0.1 * longest; });
  if (strokes.size() < kLeastStrokes)
    throw Error(std::to_string(strokes.size()) + " strokes are too few, " +
                    std::to_string(kLeastStrokes) + " are needed",
                kFrictionWhere, "Stroke back and forth over the surface");
  return strokes;
}

/// drag = mu f_n + B speed, where it slides.
Eigen::Vector2d slidingLaw(const std::vector<Stroke>& strokes) {
  Eigen::Matrix2d A = Eigen::Matrix2d::Zero();
  Eigen::Vector2d b = Eigen::Vector2d::Zero();
  for (const Stroke& stroke : strokes)
    for (const Along& s : stroke) {
      if (s.way < 0.5 * stroke.back().way) continue;
      const Eigen::Vector2d row(s.f_n, s.speed);
      A += row * row.transpose();
      b += row * s.drag;
    }
  return minimumNorm(A, b);
}

/// ln((F_c - F) / (F_c - F_0)) = -sigma way / F_c, weighted by what is left to F_c.
double presliding(const std::vector<Stroke>& strokes, double mu, double B) {
  double across = 0, along = 0;
  for (const Stroke& stroke : strokes) {
    const double first = mu * stroke.front().f_n - (stroke.front().drag - B * stroke.front().speed);
    for (const Along& s : stroke) {
      const double limit = mu * s.f_n, left = limit - (s.drag - B * s.speed);
      if (!(first > 0.1 * limit) || left < 0.15 * first || left > 0.95 * first) continue;
      const double x = (s.way - stroke.front().way) / limit, weight = left * left;
      across += weight * x * -std::log(left / first);
      along += weight * x * x;
    }
  }
  return along > 0 ? across / along : 0;
}

/// The law run over the whole recording; state: (ln mu, ln sigma, B).
class SlideFit {
 public:
  SlideFit(const std::vector<SlideSample>& samples, double dt, const Dahl& start)
      : samples_(samples),
        dt_(dt),
        p_(std::log(start.mu), std::log(start.sigma), start.B),
        scale_(1, 1, std::max(start.mu, 0.1)) {}
  Fit run(double drag_rms) {
    return nearFit({static_cast<int>(samples_.size()) - 1, 2, 3,
                    [this](const VectorX& dp) { return residuals(dp); },
                    [this](const VectorX& dp) { p_ += dp.cwiseProduct(scale_); }},
                   drag_rms, kFrictionWhere);
  }
  Dahl law() const { return lawAt(p_); }
  double misfit() const { return residuals(VectorX::Zero(3)).squaredNorm(); }
  Mat3 covariance(const Fit& fit) const {
    const Vec3 D(std::exp(p_[0]), std::exp(p_[1]), scale_[2]);
    return D.asDiagonal() * fit.covariance * D.asDiagonal();
  }

 private:
  static Dahl lawAt(const Vec3& p) { return {std::exp(p[0]), std::exp(p[1]), p[2]}; }
  VectorX residuals(const VectorX& dp) const {
    const Dahl law = lawAt(p_ + Vec3(dp).cwiseProduct(scale_));
    haptics::DahlState state;
    VectorX r(2 * (samples_.size() - 1));
    for (std::size_t i = 1; i < samples_.size(); ++i) {
      const SlideSample& s = samples_[i];
      const Vec3 drag = haptics::dragOf(law, s.p - samples_[i - 1].p, s.n, s.f_n, dt_, &state);
      const Vec3 one = s.n.unitOrthogonal(), other = s.n.cross(one),
                 left = s.f_n > 0 ? Vec3(s.drag - drag) : Vec3(Vec3::Zero());
      r.segment<2>(static_cast<Eigen::Index>(2 * (i - 1))) << left.dot(one), left.dot(other);
    }
    return r;
  }
  const std::vector<SlideSample>& samples_;
  double dt_;
  Vec3 p_, scale_;
};

/// Divide and conquer's answer, or, where a trembling hand blurs where strokes begin, the best of
/// some that lie around what slides: everything it says of sliding, and sliding after a twentieth
/// of a millimetre to one and a half.
Dahl startFor(const std::vector<SlideSample>& samples, double dt, const Eigen::Vector2d& sliding,
              double sigma) {
  double dragged = 0, pressed = 0;
  for (const SlideSample& s : samples) {
    dragged += inPlane(s.drag, s.n).norm() * std::max(s.f_n, 0.0);
    pressed += s.f_n * s.f_n;
  }
  Dahl best{sliding[0], sigma, sliding[1]};
  double least = SlideFit(samples, dt, best).misfit();
  const double f_n = std::sqrt(pressed / static_cast<double>(samples.size()));
  for (const double mu : {sliding[0], dragged / pressed}) {
    for (const double bends : {5e-5, 1.5e-4, 5e-4, 1.5e-3}) {
      const Dahl one{mu, mu * f_n / bends, std::max(sliding[1], 0.0)};
      const double misfit = SlideFit(samples, dt, one).misfit();
      if (!(misfit < least)) continue;
      least = misfit;
      best = one;
    }
  }
  return best;
}

}  // namespace

SurfaceFriction identifySurfaceFriction(const std::vector<SlideSample>& samples, double dt) {
  requireNumbers(samples, dt);
  const std::vector<Stroke> strokes = strokesOf(samples, dt);
  const Eigen::Vector2d sliding = slidingLaw(strokes);
  if (!(sliding[0] > 0))
    throw Error("nothing drags along the motion", kFrictionWhere,
                "Is the sign of the force right, and does the tool touch?");
  const double sigma = presliding(strokes, sliding[0], sliding[1]);
  if (!(sigma > 0))
    throw Error("no stroke shows how the tool begins to slide", kFrictionWhere,
                "Stroke back and forth without lifting the tool");
  SlideFit fit(samples, dt, startFor(samples, dt, sliding, sigma));
  SurfaceFriction found;
  double squares = 0, slowest = 1e9, fastest = 0;
  for (const SlideSample& s : samples)
    squares += inPlane(s.drag, s.n).squaredNorm() / (2 * static_cast<double>(samples.size()));
  found.fit = fit.run(std::sqrt(squares));
  found.law = fit.law();
  found.covariance = fit.covariance(found.fit);
  found.rms = found.fit.sigma;
  found.relative_rms = squares > 0 ? found.rms / std::sqrt(squares) : 0;
  for (const Stroke& stroke : strokes) {
    const Along& end = stroke.back();
    found.slid = std::max(found.slid, end.way * found.law.sigma / (found.law.mu * end.f_n));
    double top = 0;
    for (const Along& s : stroke) top = std::max(top, s.speed);
    slowest = std::min(slowest, top);
    fastest = std::max(fastest, top);
  }
  if (found.slid < kSlidFar)
    throw Error("the tool never slid: it only bent the surface", kFrictionWhere, "Stroke further");
  const Vec3 half = 1.96 * found.covariance.diagonal().cwiseSqrt();
  if (!half.allFinite() || half[2] * fastest > 0.2 * found.law.mu)
    throw Error("the speeds are too alike to tell the viscous part", kFrictionWhere,
                "Stroke slowly and fast");
  if (half[1] > 0.3 * found.law.sigma)
    found.advice = "Stroke in short ways back and forth: the beginning of sliding is hardly told.";
  else if (fastest < 2 * slowest)
    found.advice = "Stroke once slowly, once fast.";
  found.law.B = std::max(found.law.B, 0.0);
  return found;
}

}  // namespace palpa::calibration
