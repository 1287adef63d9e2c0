#include "anatomy/query/bone_capsules.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include <Eigen/Cholesky>

#include "anatomy/geometry/dense_solvers.h"

namespace palpa::anatomy {
namespace {

constexpr double kThinnest = 0.001, kThickest = 0.020;  // radius of a rod
constexpr double kSeedHalf = 0.010;                     // half of a new rod's length, at most
constexpr double kSeedGive = 0.0005;                    // by which a new rod may stick out
constexpr double kAxisReach = 0.012;  // of the surface round a place tells where the bone goes
constexpr double kCovered = 0.0045;   // so far off, a sample wants a rod before anything is refined
constexpr int kStepsBetween = 3, kStepsAtLast = 12;
using Vec7 = Eigen::Matrix<double, 7, 1>;
using Mat7 = Eigen::Matrix<double, 7, 7>;

class RodFitter {
 public:
  explicit RodFitter(const std::vector<SurfaceSample>& samples)
      : samples_(samples), off_(samples.size(), 1.0), whose_(samples.size(), -1) {}

  RodFit run(double good_rms, int most) {
    while (static_cast<int>(rods_.size()) < most && farthestOff() > kCovered) addRod();
    refine(2 * kStepsBetween);
    while (static_cast<int>(rods_.size()) < most && rms() > good_rms) {
      const int more = std::max<int>(1, static_cast<int>(rods_.size()) / 8);
      for (int i = 0; i < more && static_cast<int>(rods_.size()) < most; ++i) addRod();
      refine(kStepsBetween);
    }
    refine(kStepsAtLast);
    return {used(), rms()};
  }

 private:
  double rms() const { return std::sqrt(cost_ / static_cast<double>(samples_.size())); }

  /// Without those that others have come to cover.
  std::vector<Rod> used() const {
    std::vector<Rod> rods;
    for (std::size_t k = 0; k < rods_.size(); ++k)
      if (std::find(whose_.begin(), whose_.end(), static_cast<int>(k)) != whose_.end())
        rods.push_back(rods_[k]);
    return rods;
  }

  std::size_t worst() const {
    return static_cast<std::size_t>(std::max_element(off_.begin(), off_.end()) - off_.begin());
  }
  double farthestOff() const { return off_[worst()]; }

  void addRod() {
    const SurfaceSample& s = samples_[worst()];
    const Vec3 along = alongSurface(samples_, s.p, kAxisReach);
    const Vec3 across = along - along.dot(s.n) * s.n;
    const bool has_way = across.norm() > 0.5;
    const Vec3 u = has_way ? Vec3(across.normalized()) : Vec3(Vec3::Zero());
    rods_.push_back(
        inscribedRod(samples_, s.p, s.n, u, kSeedGive, kThickest, has_way ? kSeedHalf : 0));
    offer(static_cast<int>(rods_.size()) - 1);
  }

  /// Who is nearest to each sample, and how near.
  void assign() {
    std::fill(off_.begin(), off_.end(), 1.0);
    for (std::size_t k = 0; k < rods_.size(); ++k) offer(static_cast<int>(k));
  }

  /// The k-th rod takes the samples to which it is nearer than those before.
  void offer(int k) {
    cost_ = 0;
    for (std::size_t i = 0; i < samples_.size(); ++i) {
      const double d = distanceTo(rods_[k], samples_[i].p);
      if (d < off_[i]) {
        off_[i] = d;
        whose_[i] = k;
      }
      cost_ += off_[i] * off_[i];
    }
  }

  void refine(int steps) {
    double damping = 0.1;
    for (int i = 0; i < steps; ++i) {
      const std::vector<Rod> before = rods_;
      const std::vector<double> off_before = off_;
      const std::vector<int> whose_before = whose_;
      const double cost_before = cost_;
      move(damping);
      assign();
      if (cost_ < cost_before) {
        damping = std::max(damping / 3, 1e-3);
        continue;
      }
      rods_ = before;
      off_ = off_before;
      whose_ = whose_before;
      cost_ = cost_before;
      damping *= 5;
    }
  }

  /// One damped Gauss-Newton step of every rod on its own samples.
  void move(double damping) {
    std::vector<Mat7> A(rods_.size(), Mat7::Zero());
    std::vector<Vec7> right(rods_.size(), Vec7::Zero());
    for (std::size_t i = 0; i < samples_.size(); ++i) {
      const Rod& rod = rods_[whose_[i]];
      Vec3 foot;
      const double d = distanceTo(rod, samples_[i].p, &foot);
      const Vec3 u = (samples_[i].p - foot).normalized();
      const double length2 = (rod.b - rod.a).squaredNorm();
      const double t = length2 > 0 ? (foot - rod.a).dot(rod.b - rod.a) / length2 : 0.5;
      Vec7 J;
      J << (t - 1) * u, -t * u, -1;
      A[whose_[i]] += J * J.transpose();
      right[whose_[i]] -= d * J;
    }
    for (std::size_t k = 0; k < rods_.size(); ++k) {
      const double weight = A[k](6, 6);  // its samples
      if (weight < 1) continue;
      A[k].diagonal().array() += damping * weight;
      const Vec7 step = A[k].ldlt().solve(right[k]);
      Rod& rod = rods_[k];
      rod.a += step.head<3>();
      rod.b += step.segment<3>(3);
      rod.radius = std::clamp(rod.radius + step[6], kThinnest, kThickest);
    }
  }

  const std::vector<SurfaceSample>& samples_;
  std::vector<Rod> rods_;
  std::vector<double> off_;  ///< of each sample from the union
  std::vector<int> whose_;   ///< the rod nearest to it
  double cost_ = 0;
};

}  // namespace

double distanceTo(const Rod& rod, const Vec3& p, Vec3* foot) {
  const Vec3 core = rod.b - rod.a, from_a = p - rod.a;
  const double length2 = core.squaredNorm();
  const double t = length2 > 0 ? std::clamp(from_a.dot(core) / length2, 0.0, 1.0) : 0.0;
  const Vec3 off = from_a - t * core;
  if (foot) *foot = p - off;
  return off.norm() - rod.radius;
}

double inscribedRadius(const std::vector<SurfaceSample>& samples, const Vec3& p, const Vec3& n,
                       double give, double most) {
  double radius = most;
  for (const SurfaceSample& s : samples) {
    const Vec3 back = p - s.p;
    const double depth = n.dot(back) - give;
    if (depth <= 0) continue;
    const double squared = back.squaredNorm() - give * give;
    if (squared < 2 * radius * depth) radius = squared / (2 * depth);
  }
  return std::max(radius, kThinnest);
}

Rod inscribedRod(const std::vector<SurfaceSample>& samples, const Vec3& p, const Vec3& n,
                 const Vec3& u, double give, double most, double half) {
  const double radius = inscribedRadius(samples, p, n, give, most);
  const Vec3 c = p - radius * n;
  const double free = std::max(radius - give, 0.0);
  double forward = half, backward = half;
  for (const SurfaceSample& s : samples) {
    const Vec3 to = s.p - c;
    const double t = to.dot(u), across2 = to.squaredNorm() - t * t;
    if (across2 >= free * free) continue;
    const double end = std::max(std::abs(t) - std::sqrt(free * free - across2), 0.0);
    double& limit = t > 0 ? forward : backward;
    limit = std::min(limit, end);
  }
  return {c - backward * u, c + forward * u, radius};
}

Vec3 alongSurface(const std::vector<SurfaceSample>& samples, const Vec3& p, double reach) {
  Mat3 covariance = Mat3::Zero();
  for (const SurfaceSample& s : samples) {
    const double w = 1 - (s.p - p).squaredNorm() / (reach * reach);
    if (w > 0) covariance += w * w * s.n * s.n.transpose();
  }
  return symmetricEigen(covariance).vectors.col(0);
}

RodFit fitRods(const std::vector<SurfaceSample>& samples, double good_rms, int most) {
  if (samples.empty() || most < 1) return {};
  return RodFitter(samples).run(good_rms, most);
}

namespace {

constexpr int kMostRods = 48;
constexpr std::size_t kMostSamples = 800, kMostJudges = 800;
constexpr double kGoodRms = 0.0005, kWorstRms = 0.001;
constexpr double kReach = 0.026;  // rods further from the touched place are left out
constexpr double kGive =
    0.0003;  // by which the touching capsule may stick out beside the touched place
constexpr double kThickestTouch = 0.020;
constexpr double kHalfTouch = 0.008;  // half of the touching capsule's length, at most
constexpr double kBoneAxisReach = 0.012;
constexpr double kEndOfBone = 0.7;  // cosine: there the normal runs along the bone
constexpr double kHidden =
    0.0001;  // a rod that sticks so little out of the touching one says nothing new

/// The k-th of some vertices out of a long list, spread evenly over it whatever its order: by the
/// golden ratio.
std::size_t spread(std::size_t k, std::size_t all) {
  constexpr double kGolden = 0.6180339887498949;
  const double at = kGolden * static_cast<double>(k + 1);
  return std::min(static_cast<std::size_t>((at - std::floor(at)) * static_cast<double>(all)),
                  all - 1);
}

/// Every vertex of a small mesh; of a large one as many as will do.
std::vector<SurfaceSample> samplesOf(const TriangleMesh& mesh) {
  const std::size_t all = mesh.points.size(), count = std::min(all, kMostSamples);
  std::vector<SurfaceSample> samples;
  samples.reserve(count);
  for (std::size_t k = 0; k < count; ++k) {
    const std::size_t i = count == all ? k : spread(k, all);
    samples.push_back({mesh.points[i], mesh.normals[i]});
  }
  return samples;
}

/// Of vertices beside the samples, from the union of the rods.
double misfitBeside(const TriangleMesh& mesh, std::size_t samples, const std::vector<Rod>& rods) {
  const std::size_t count = std::min(mesh.points.size() - samples, kMostJudges);
  double squares = 0;
  for (std::size_t k = 0; k < count; ++k) {
    double off = 1;
    for (const Rod& rod : rods)
      off = std::min(off, distanceTo(rod, mesh.points[spread(samples + k, mesh.points.size())]));
    squares += off * off;
  }
  return std::sqrt(squares / static_cast<double>(count));
}

bool hides(const Rod& outer, const Rod& inner) {
  const double room = -inner.radius + kHidden;
  return distanceTo(outer, inner.a) <= room && distanceTo(outer, inner.b) <= room;
}

Capsule capsuleOf(const Rod& rod) {
  return {pack(rod.a), pack(rod.b), rod.radius, Organ::none, 0, {}};
}

}  // namespace

BoneCapsules::BoneCapsules(const TriangleMesh& mesh) : samples_(samplesOf(mesh)) {
  const RodFit fit = fitRods(samples_, kGoodRms, kMostRods);
  rods_ = fit.rods;
  rms_ =
      samples_.size() < mesh.points.size() ? misfitBeside(mesh, samples_.size(), rods_) : fit.rms;
}

Rod BoneCapsules::touching(const SurfacePoint& nearest) const {
  const Vec3 &p = nearest.p_A, &n = nearest.n_A, along = alongSurface(samples_, p, kBoneAxisReach);
  const bool end = std::abs(along.dot(n)) >= kEndOfBone;
  const Vec3 u = end ? Vec3(Vec3::Zero()) : Vec3((along - along.dot(n) * n).normalized());
  return inscribedRod(samples_, p, n, u, kGive, kThickestTouch, end ? 0 : kHalfTouch);
}

std::vector<Capsule> BoneCapsules::near(const SurfacePoint& nearest, int most) const {
  if (rods_.empty() || rms_ > kWorstRms || most < 1) return {};
  const Rod touch = touching(nearest);
  std::vector<Capsule> capsules{capsuleOf(touch)};
  if (most == 1) return capsules;

  std::vector<std::pair<double, Rod>> others;
  for (const Rod& rod : rods_) {
    Vec3 foot;
    const double d = distanceTo(rod, nearest.p_A, &foot);
    if (d > kReach) continue;
    const Vec3 back = std::min(d, 0.0) *
                      (nearest.p_A - foot).normalized();  // until it no longer covers the place
    const Rod moved{rod.a + back, rod.b + back, rod.radius};
    if (!hides(touch, moved)) others.emplace_back(d, moved);
  }
  std::stable_sort(others.begin(), others.end(),
                   [](const auto& a, const auto& b) { return a.first < b.first; });
  const std::size_t count = std::min(others.size(), static_cast<std::size_t>(most - 1));
  for (std::size_t k = 0; k < count; ++k) capsules.push_back(capsuleOf(others[k].second));
  return capsules;
}

}  // namespace palpa::anatomy
