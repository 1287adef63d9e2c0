#include "anatomy/parametric/taught_line.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <limits>
#include <numbers>

#include "anatomy/base/error.h"
#include "anatomy/shapes/mesh_tools.h"
#include "anatomy/shapes/root.h"

namespace palpa::anatomy {
namespace {

constexpr double kBelowBorder = 10;  // the entry: 1 cm caudal of the clavicle's lower border
constexpr double kNormalStep = 1.6;  // half a cell of the skin's mesh, which shows no finer slope

// The skin's front from the midline to beyond the entry as a fine mesh: its nearest point is the
// nearest of all, where a descent on the field could stop at another side of the clavicle's ridge.
TriangleTree frontOf(const BodySurface& skin, double lateral) {
  constexpr double kFirst = 2, kLowest = -42, kHighest = 38, kCell = 1.6;
  const int columns = static_cast<int>((lateral - kFirst) / kCell);
  const int rows = static_cast<int>((kHighest - kLowest) / kCell);
  TriangleMesh patch;
  for (int r = 0; r < rows; ++r)
    for (int c = 0; c < columns; ++c) {
      const double l = kFirst + kCell * c, z = kLowest + kCell * r;
      patch.points.emplace_back(l, skin.front(l, z), z);
      if (r == 0 || c == 0) continue;
      const auto here = static_cast<std::uint32_t>(patch.points.size() - 1);
      const std::uint32_t below = here - static_cast<std::uint32_t>(columns);
      patch.triangles.push_back({below - 1, below, here});
      patch.triangles.push_back({below - 1, here, here - 1});
    }
  computeNormals(&patch);
  return TriangleTree(patch);
}

double lineClearance(const TriangleTree& surface, const Vec3& a, const Vec3& b) {
  constexpr int kSamples = 50;
  double least = std::numeric_limits<double>::infinity();
  for (int i = 0; i <= kSamples; ++i)
    least = std::min(least, surface.closest(a + (b - a) * i / kSamples).signed_distance);
  return least;
}

std::string rounded(double value) {
  char text[32];
  std::snprintf(text, sizeof text, "%.1f", value);
  return text;
}
std::string degrees(double radians) { return rounded(radians * 180 / std::numbers::pi); }

std::string violated(const TaughtLine& line, const TaughtLimits& limits) {
  if (line.clearance < limits.clearance - 0.1 || line.clearance > limits.highest_clearance)
    return "the needle would pass the clavicle at " + rounded(line.clearance) + " mm instead of " +
           rounded(limits.clearance) + " to " + rounded(limits.highest_clearance) + " mm";
  if (line.angle < limits.lowest_angle || line.angle > limits.highest_angle)
    return "the needle would enter at " + degrees(line.angle) + " degrees to the skin instead of " +
           degrees(limits.lowest_angle) + " to " + degrees(limits.highest_angle);
  if (line.length > limits.longest)
    return "the way to the vein is " + rounded(line.length) + " mm, more than " +
           rounded(limits.longest) + " mm";
  if (line.target.z() < line.entry.z()) return "the line would not run cephalad";
  return "";
}

}  // namespace

TaughtLineSearch::TaughtLineSearch(const BodySurface& skin, const Clavicle& clavicle)
    : skin_(skin), bone_(clavicle.mesh), front_(frontOf(skin, clavicle.medial_third.x() + 10)) {
  const double l = clavicle.medial_third.x();
  const double z = clavicle.lowerBorder(1.0 / 3) - kBelowBorder;
  entry_ = {l, skin.front(l, z), z};
  normal_ = gradient(std::cref(skin), entry_, kNormalStep).normalized();
}

// To the point at (l, z) whose nearest skin is as far as the lumen's centre is to lie deep.
TaughtLine TaughtLineSearch::lineTo(double l, double z, double centre_depth) const {
  const auto excess = [&](double y) {
    return (front_.closest({l, y, z}).p - Vec3(l, y, z)).norm() - centre_depth;
  };
  const double front = skin_.front(l, z);
  const double y = findRoot(excess, front + 0.5 * centre_depth, front + 2 * centre_depth, 1e-3);
  TaughtLine line{entry_, normal_, {l, y, z}, front_.closest({l, y, z}).p};
  const Vec3 way = line.target - entry_;
  line.length = way.norm();
  line.angle = std::asin(-way.dot(normal_) / line.length);
  line.clearance = lineClearance(bone_, entry_, line.target);
  line.target_to_bone = bone_.closest(line.target).signed_distance;
  return line;
}

TaughtLine TaughtLineSearch::find(double l, double centre_depth, double vein_radius,
                                  const TaughtLimits& limits) const {
  // Higher targets lie closer to the bone. Wanted: the axis at the clearance, and the vein's wall
  // not in the bone.
  const auto excess = [&](double z) {
    TaughtLine line = lineTo(l, z, centre_depth);
    return std::min(line.clearance - limits.clearance,
                    line.target_to_bone - vein_radius - limits.vein_to_bone);
  };
  const double z = findRoot(excess, entry_.z() - 8, entry_.z() + 22, 0.01);
  TaughtLine line = lineTo(l, z, centre_depth);
  const std::string reason = violated(line, limits);
  if (!reason.empty())
    throw Error(reason, "parametric patient, taught line",
                "Choose a vein depth, clavicle or layers nearer to the means");
  return line;
}

}  // namespace palpa::anatomy
