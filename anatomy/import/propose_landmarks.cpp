#include "anatomy/import/propose_landmarks.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include "anatomy/geometry/dense_solvers.h"

namespace palpa::anatomy {
namespace {

constexpr double kInside = 0.002;  // of the clavicle's extremes its ends are cut
constexpr double kNotchReach =
    0.035;  // of the middle between the sternal ends the notch lies within
constexpr double kNan = std::numeric_limits<double>::quiet_NaN();

Eigen::AlignedBox3d boxAround(const TriangleMesh& mesh) {
  Eigen::AlignedBox3d box;
  for (const Vec3& p : mesh.points) box.extend(p);
  return box;
}

/// Segments in which the plane n . (x - p) = 0 cuts the triangles.
template <class Visit>
void eachCut(const TriangleMesh& mesh, const Vec3& p, const Vec3& n, Visit visit) {
  for (const auto& t : mesh.triangles) {
    Vec3 ends[3];
    int found = 0;
    for (std::size_t k = 0; k < 3; ++k) {
      const Vec3 &a = mesh.points[t[k]], &b = mesh.points[t[(k + 1) % 3]];
      const double above_a = n.dot(a - p), above_b = n.dot(b - p);
      if ((above_a < 0) == (above_b < 0)) continue;
      ends[found++] = a + (b - a) * (above_a / (above_a - above_b));
    }
    if (found == 2) visit(ends[0], ends[1]);
  }
}

/// The clavicle's long axis as a line with the surface's extremes on it; `sternal` is the end
/// nearer to the midplane.
struct LongAxis {
  Vec3 middle, direction;  // from the sternal to the acromial end
  double sternal = 0, acromial = 0;

  Vec3 at(double share) const {
    return middle + (sternal + share * (acromial - sternal)) * direction;
  }
  double length() const { return acromial - sternal; }
};

LongAxis longAxisOf(const TriangleMesh& mesh, double midplane) {
  Vec3 mean = Vec3::Zero();
  double area = 0;
  const auto eachTriangle = [&](auto visit) {
    for (const auto& t : mesh.triangles) {
      const Vec3 &a = mesh.points[t[0]], &b = mesh.points[t[1]], &c = mesh.points[t[2]];
      visit((a + b + c) / 3, 0.5 * (b - a).cross(c - a).norm());
    }
  };
  eachTriangle([&](const Vec3& centre, double weight) { mean += weight * centre, area += weight; });
  mean /= area;
  Mat3 spread = Mat3::Zero();
  eachTriangle([&](const Vec3& centre, double weight) {
    spread += weight * (centre - mean) * (centre - mean).transpose();
  });
  LongAxis axis{mean, symmetricEigen(spread).vectors.col(2)};
  if (std::abs(mean.x() + 0.05 * axis.direction.x() - midplane) <
      std::abs(mean.x() - 0.05 * axis.direction.x() - midplane))
    axis.direction = -axis.direction;
  axis.sternal = kNan;
  for (const Vec3& p : mesh.points) {
    const double along = axis.direction.dot(p - mean);
    axis.sternal = std::isnan(axis.sternal) ? along : std::min(axis.sternal, along);
    axis.acromial = std::max(axis.acromial, along);
  }
  return axis;
}

class Proposer {
 public:
  explicit Proposer(Patient* patient) : patient_(*patient) {}

  std::vector<std::string> run() {
    findMidplane();
    for (const OrganSurface& surface : patient_.organs)
      if (surface.organ == Organ::clavicle) {
        const bool left = boxAround(surface.mesh).center().x() > midplane_;
        (left == (patient_.side == Side::left) ? here_ : there_) = &surface;
      }
    if (here_)
      clavicle();
    else
      say("no clavicle of the " + std::string(name(patient_.side)) +
          " side: its landmarks are not proposed");
    notch();
    cannot();
    return std::move(words_);
  }

 private:
  void say(const std::string& sentence) { words_.push_back(sentence); }

  bool propose(const char* key, const Vec3& p) {
    if (patient_.landmarks.count(key) || !p.allFinite()) return false;
    patient_.landmarks[key] = p;
    return true;
  }

  void findMidplane() {
    Eigen::AlignedBox3d sternum, clavicles;
    int bones = 0;
    for (const OrganSurface& surface : patient_.organs) {
      if (surface.organ == Organ::sternum) sternum.extend(boxAround(surface.mesh));
      if (surface.organ == Organ::clavicle) clavicles.extend(boxAround(surface.mesh)), ++bones;
    }
    if (!sternum.isEmpty())
      midplane_ = sternum.center().x();
    else if (bones == 2)
      midplane_ = clavicles.center().x();
    else
      say("neither a sternum nor two clavicles: the midplane is taken where the files have x = 0");
  }

  static Vec3 endOf(const OrganSurface& clavicle, const LongAxis& axis) {
    return middleOfSection(clavicle.mesh, axis.at(kInside / axis.length()), axis.direction);
  }

  void clavicle() {
    const TriangleMesh& mesh = here_->mesh;
    const LongAxis axis = longAxisOf(mesh, midplane_);
    bool any = propose(landmark::kSternalEnd, endOf(*here_, axis));
    any |= propose(landmark::kAcromialEnd,
                   middleOfSection(mesh, axis.at(1 - kInside / axis.length()), axis.direction));
    any |= propose(landmark::kMedialThird, middleOfSection(mesh, axis.at(1.0 / 3), axis.direction));
    any |=
        propose(landmark::kLateralThird, middleOfSection(mesh, axis.at(2.0 / 3), axis.direction));
    any |= propose(landmark::kSternalEndPosteriorSuperior, posteriorSuperior(mesh, axis));
    if (any) say("ends and thirds of " + here_->id + " from its long axis and sections");
  }

  /// Of the section through the sternal end the point farthest back and up.
  static Vec3 posteriorSuperior(const TriangleMesh& mesh, const LongAxis& axis) {
    Vec3 best = Vec3::Constant(kNan);
    eachCut(mesh, axis.at(kInside / axis.length()), axis.direction,
            [&](const Vec3& a, const Vec3& b) {
              for (const Vec3& p : {a, b})
                if (!best.allFinite() || p.y() + p.z() > best.y() + best.z()) best = p;
            });
    return best;
  }

  std::optional<Vec3> highestOfSternum() const {
    std::optional<Vec3> highest;
    for (const OrganSurface& surface : patient_.organs)
      if (surface.organ == Organ::sternum)
        eachCut(surface.mesh, Vec3(midplane_, 0, 0), Vec3::UnitX(),
                [&](const Vec3& a, const Vec3& b) {
                  for (const Vec3& p : {a, b})
                    if (!highest || p.z() > highest->z()) highest = p;
                });
    return highest;
  }

  void notch() {
    if (patient_.landmarks.count(landmark::kNotch)) return;
    std::optional<Vec3> between;
    if (here_ && there_)
      between = 0.5 * (endOf(*here_, longAxisOf(here_->mesh, midplane_)) +
                       endOf(*there_, longAxisOf(there_->mesh, midplane_)));
    const std::optional<Vec3> sternum = highestOfSternum();
    if (sternum && (!between || (*sternum - *between).norm() <= kNotchReach)) {
      if (propose(landmark::kNotch, *sternum))
        say("suprasternal notch at the highest point of the sternum in the midplane, on the bone");
    } else if (between && propose(landmark::kNotch, *between)) {
      say("suprasternal notch midway between the sternal ends of the clavicles");
    }
  }

  void cannot() {
    std::string list;
    for (const char* key : {landmark::kNotch, landmark::kSternalEnd, landmark::kAcromialEnd,
                            landmark::kMedialThird, landmark::kEntry, landmark::kVeinTarget})
      if (!patient_.landmarks.count(key)) list += (list.empty() ? "" : ", ") + std::string(key);
    if (!list.empty()) say("not proposed, the meshes do not show them: " + list);
  }

  Patient& patient_;
  std::vector<std::string> words_;
  double midplane_ = 0;
  const OrganSurface *here_ = nullptr,
                     *there_ = nullptr;  // clavicles of the punctured and the other side
};

}  // namespace

Vec3 middleOfSection(const TriangleMesh& mesh, const Vec3& p, const Vec3& n) {
  Vec3 sum = Vec3::Zero();
  double length = 0;
  eachCut(mesh, p, n, [&](const Vec3& a, const Vec3& b) {
    sum += (b - a).norm() * 0.5 * (a + b);
    length += (b - a).norm();
  });
  return length > 0 ? Vec3(sum / length) : Vec3::Constant(kNan);
}

std::vector<std::string> proposeLandmarks(Patient* patient) { return Proposer(patient).run(); }

}  // namespace palpa::anatomy
