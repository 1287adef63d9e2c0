#include "apps/bench/pictures/tool_outline.h"

#include <array>
#include <cmath>
#include <numbers>
#include <opencv2/imgproc.hpp>
#include <vector>

#include "scene/actors/instrument.h"

namespace palpa::bench {
namespace {

constexpr double kBeforeLens = 0.02;  // m
constexpr int kRound = 24;            // points of a circle

/// A piece of a tool about its axis, from one end to the other.
struct Cone {
  double z0, r0, z1, r1;  // m
};

std::vector<Cone> needlePieces(double plunger) {
  const scene::InstrumentSize size;
  const double hub = -size.needle_length, front = size.barrel_front,
               back = front - size.barrel_length;
  constexpr double kHub = 0.0038, kPlunger = 0.010;
  return {{0, 0.0001, -size.bevel_length, size.needle_radius},
          {-size.bevel_length, size.needle_radius, hub, size.needle_radius},
          {hub, kHub, hub - 0.016, kHub},
          {front, size.barrel_radius, back, size.barrel_radius},
          {back, kPlunger, back - 0.012 - plunger * size.stroke, kPlunger}};
}

std::vector<Cone> probePieces() {
  const scene::ProbeSize size;
  const double r = size.tip_radius;
  std::vector<Cone> pieces;
  for (double u = 0; u < 1; u += 0.25) {  // its half-sphere, in slices
    const auto radius = [&](double depth) { return r * std::sqrt(depth * (2 - depth)); };
    pieces.push_back({-u * r, radius(u), -(u + 0.25) * r, radius(u + 0.25)});
  }
  pieces.push_back({-r, r, -1.6 * r, r});
  pieces.push_back({-1.6 * r, size.shaft_radius, size.shaft_end, size.shaft_radius});
  pieces.push_back({size.shaft_end, size.handle_radius, size.handle_end, size.handle_radius});
  return pieces;
}

void fill(const Cone& piece, const Pose& X_AT, const scene::ArGeometry& eye, double scale,
          cv::Mat1b* mask) {
  std::vector<cv::Point2f> outline;
  for (int i = 0; i < kRound; ++i) {
    const double angle = 2 * std::numbers::pi * i / kRound;
    const Vec3 round(std::cos(angle), std::sin(angle), 0);
    for (const Vec3& p : {Vec3(piece.r0 * round + piece.z0 * Vec3::UnitZ()),
                          Vec3(piece.r1 * round + piece.z1 * Vec3::UnitZ())}) {
      const auto px = pixelOf(eye, X_AT * p);
      if (!px) return;
      outline.emplace_back(static_cast<float>(scale * px->x()),
                           static_cast<float>(scale * px->y()));
    }
  }
  std::vector<cv::Point2f> hull;
  cv::convexHull(outline, hull);
  std::vector<cv::Point> corners;
  for (const cv::Point2f& p : hull)
    corners.emplace_back(static_cast<int>(std::lround(p.x)), static_cast<int>(std::lround(p.y)));
  cv::fillConvexPoly(*mask, corners, 255);
}

}  // namespace

std::optional<Eigen::Vector2d> pixelOf(const scene::ArGeometry& eye, const Vec3& p_A) {
  const Vec3 p = eye.X_CA * p_A;
  if (p.z() < kBeforeLens) return std::nullopt;
  const scene::Pinhole& c = eye.camera;
  return Eigen::Vector2d(c.fx * p.x() / p.z() + c.cx, c.fy * p.y() / p.z() + c.cy);
}

cv::Mat1b toolOutline(const scene::SceneState& state, const scene::ArGeometry& eye,
                      const cv::Size& window, double scale) {
  cv::Mat1b mask(static_cast<int>(scale * window.height), static_cast<int>(scale * window.width),
                 uchar(0));
  const auto draw = [&](const std::vector<Cone>& pieces, const Pose& X_AT) {
    for (const Cone& piece : pieces) fill(piece, X_AT, eye, scale, &mask);
  };
  draw(state.tool == scene::Tool::needle ? needlePieces(state.plunger) : probePieces(), state.X_AT);
  if (state.second_X_AT) draw(probePieces(), *state.second_X_AT);
  const cv::Rect seen(static_cast<int>(scale * eye.x), static_cast<int>(scale * eye.y),
                      static_cast<int>(scale * eye.width), static_cast<int>(scale * eye.height));
  cv::Mat1b within(mask.size(), uchar(0));
  const cv::Rect inside = seen & cv::Rect({0, 0}, mask.size());
  mask(inside).copyTo(within(inside));
  return within;
}

SkinRay::SkinRay(const anatomy::Patient& patient) : skin_(patient.organ(Organ::skin).mesh) {}

std::optional<double> SkinRay::along(const Vec3& from_A, const Vec3& way, double length) const {
  std::array<anatomy::TriangleTree::Crossing, 16> crossings;
  bool lost = false;
  const int count =
      skin_.cast(from_A, way, length, crossings.data(), static_cast<int>(crossings.size()), &lost);
  std::optional<double> first;
  for (int k = 0; k < count; ++k)
    if (const double s = crossings[static_cast<std::size_t>(k)].s; !first || s < *first) first = s;
  return first;
}

}  // namespace palpa::bench
