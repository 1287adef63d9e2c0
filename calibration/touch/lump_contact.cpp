#include "calibration/touch/contact_laws.h"

#include <algorithm>
#include <cmath>

#include "anatomy/base/error.h"
#include "calibration/robust_fit.h"

namespace palpa::calibration {
namespace {

constexpr char kLumpWhere[] = "lump identification";
constexpr double kInformative = 0.05;  // of the largest force: smaller ones are left out
constexpr int kLeastTouches = 100;     // samples that tell
constexpr double kAboveLump = 0.3,
                 kBesideLump =
                     0.2;         // sine of the angle from the lump to the tool: at most, at least
constexpr double kTrifle = 1e-6;  // m, a lump that moves less than this does not move

/// f = k x^m (1 + c x'), without an offset: both where the lump rests and where the surface lies
/// are known by now. State: ln k, m, c.
class LawFit {
 public:
  explicit LawFit(std::vector<PressSample> samples) : samples_(std::move(samples)) {
    double xx = 0, xy = 0, x = 0, y = 0, n = 0;
    for (const PressSample& s : samples_) {  // a straight line through the logarithms
      const double w = s.f * s.f, lx = std::log(s.x), ly = std::log(s.f);
      n += w;
      x += w * lx;
      y += w * ly;
      xx += w * lx * lx;
      xy += w * lx * ly;
    }
    const double spread = n * xx - x * x;
    p_[1] = spread > 0 ? std::clamp((n * xy - x * y) / spread, 0.5, 4.0) : 1.0;
    p_[0] = (y - p_[1] * x) / n;
    p_[2] = 0;
  }
  haptics::HuntCrossley run() {
    double squares = 0;
    for (const PressSample& s : samples_)
      squares += s.f * s.f / static_cast<double>(samples_.size());
    nearFit({static_cast<int>(samples_.size()), 1, 3,
             [this](const VectorX& dp) { return residuals(dp); },
             [this](const VectorX& dp) { p_ += dp; }},
            std::sqrt(squares), kLumpWhere);
    return {std::exp(p_[0]), std::max(0.0, std::exp(p_[0]) * p_[2]), p_[1]};
  }

 private:
  VectorX residuals(const VectorX& dp) const {
    const Vec3 p = p_ + Vec3(dp);
    VectorX r(static_cast<Eigen::Index>(samples_.size()));
    for (std::size_t i = 0; i < samples_.size(); ++i) {
      const PressSample& s = samples_[i];
      r[static_cast<Eigen::Index>(i)] =
          s.f - std::exp(p[0]) * std::pow(s.x, p[1]) * (1 + p[2] * s.rate);
    }
    return r;
  }
  std::vector<PressSample> samples_;
  Vec3 p_;
};

haptics::HuntCrossley lawOf(std::vector<PressSample> samples, const std::string& what) {
  double largest = 0;
  for (const PressSample& s : samples) largest = std::max(largest, s.f);
  std::erase_if(samples, [&](const PressSample& s) {
    return !(s.f > kInformative * largest) || !(s.x > kTrifle);
  });
  if (static_cast<int>(samples.size()) < kLeastTouches)
    throw Error("too few samples tell " + what + " (" + std::to_string(samples.size()) + ", " +
                    std::to_string(kLeastTouches) + " are needed)",
                kLumpWhere, "Press deeper, above the lump and beside it");
  const haptics::HuntCrossley law = LawFit(std::move(samples)).run();
  if (!(law.m >= 0.5 && law.m <= 4))
    throw Error("the exponent " + std::to_string(law.m) + " of " + what + " fits no soft body",
                kLumpWhere, "Is the lump where it is said to be?");
  return law;
}

/// What the lump adds to one sample, and where it is seen from.
struct LumpForce {
  Vec3 f_T = Vec3::Zero(), line = Vec3::Zero();  ///< N; m, from lump to tip
  double sine = 0;                               ///< of the angle between line and normal
  Vec3 along = Vec3::Zero();  ///< N, f_T by its part along n, where a round tip's force must point
};

LumpForce addedBy(const LumpSample& s, const SoftContact& without, const Vec3& drag,
                  const Vec3& p_T0, double tip_radius) {
  LumpForce a;
  a.f_T = s.f_r + drag - haptics::forceOf(without.law, s.x - without.x0, s.rate) * s.n;
  a.line = s.p - p_T0 - s.d;
  const Vec3 to_middle = a.line + tip_radius * s.n;
  if (const double up = to_middle.dot(s.n); up > 0) a.along = a.f_T.dot(s.n) / up * to_middle;
  a.sine = a.line.normalized().cross(s.n).norm();
  return a;
}

/// Along one axis: how far the lump was pushed, by what.
std::vector<PressSample> pushes(const std::vector<LumpSample>& samples,
                                const std::vector<LumpForce>& added, Vec3 LumpForce::*force,
                                int axis, double dt) {
  std::vector<PressSample> pushed;
  for (std::size_t i = 1; i < samples.size(); ++i) {
    const bool tells = axis == 2 ? added[i].sine < kAboveLump : added[i].sine > kBesideLump;
    const double side = samples[i].d[axis] < 0 ? -1 : 1;  // the tool's force on the lump is -f_T
    if (tells)
      pushed.push_back({side * samples[i].d[axis],
                        side * (samples[i].d[axis] - samples[i - 1].d[axis]) / dt,
                        -side * (added[i].*force)[axis]});
  }
  return pushed;
}

}  // namespace

LumpContact identifyLump(const std::vector<LumpSample>& samples, const SoftContact& without,
                         const haptics::Dahl& friction, const Vec3& p_T0, double tip_radius,
                         double dt) {
  LumpContact found;
  std::vector<LumpForce> added;
  haptics::DahlState rubs;
  const LumpSample* before_it = nullptr;
  for (const LumpSample& s : samples) {
    if (!s.p.allFinite() || !s.f_r.allFinite() || !s.d.allFinite() || !std::isfinite(s.x) ||
        !std::isfinite(s.rate))
      throw Error("a sample is not a number", kLumpWhere, "Record again");
    const Vec3 dp = before_it ? Vec3(s.p - before_it->p) : Vec3(Vec3::Zero());
    before_it = &s;
    added.push_back(addedBy(
        s, without, haptics::dragOf(friction, dp, s.n, std::max(s.f_r.dot(s.n), 0.0), dt, &rubs),
        p_T0, tip_radius));
  }
  std::vector<PressSample> felt;
  for (std::size_t i = 1; i < samples.size(); ++i) {
    const double surface = (samples[i].p + samples[i].x * samples[i].n - p_T0).norm(),
                 before = (samples[i - 1].p + samples[i - 1].x * samples[i - 1].n - p_T0).norm();
    if (!(samples[i].x > 0) || added[i].sine > kAboveLump) continue;
    found.l0 = found.l0 > 0 ? std::min(found.l0, surface) : surface;
    const double l = surface - added[i].line.norm(), l_before = before - added[i - 1].line.norm();
    felt.push_back({l, (l - l_before) / dt, added[i].f_T.dot(added[i].line.normalized())});
  }
  found.H_T = lawOf(felt, "how hard the lump is");
  double off = 0, all = 0;
  for (const PressSample& s : felt) {
    off += std::pow(s.f - haptics::forceOf(found.H_T, s.x, s.rate), 2);
    all += s.f * s.f;
  }
  found.relative_rms = std::sqrt(off / all);
  found.G[2] =
      lawOf(pushes(samples, added, &LumpForce::f_T, 2, dt), "how the lump gives downwards");
  const auto beside = [&](int axis, const char* what) {
    const std::vector<PressSample> pushed = pushes(samples, added, &LumpForce::f_T, axis, dt);
    if (static_cast<int>(pushed.size()) >= kLeastTouches) {
      try {
        return lawOf(pushed, what);
      } catch (const Error&) {  // a trembling hand rubs more than the lump pushes aside
        return lawOf(pushes(samples, added, &LumpForce::along, axis, dt), what);
      }
    }
    found.advice =
        "Press beside the lump, too: how it gives sideways is taken from how it gives downwards.";
    return found.G[2];
  };
  found.G[0] = beside(0, "how the lump gives along x");
  found.G[1] = beside(1, "how the lump gives along y");
  return found;
}

}  // namespace palpa::calibration
