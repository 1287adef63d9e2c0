#include "scene/overlay/clearance.h"

#include <algorithm>
#include <array>

namespace palpa::scene {
namespace {

constexpr double kAround_px = 8;  // of a point
constexpr int kPlaces = 24;       // along a part

}  // namespace

Surroundings Surroundings::movedBy(const Eigen::Vector2d& px) const {
  Surroundings moved = *this;
  for (Part& part : moved.tool) part.from += px, part.to += px;
  for (Eigen::Vector2d& point : moved.points) point += px;
  return moved;
}

void Surroundings::add(const Surroundings& more) {
  for (Part part : more.tool) {
    part.eye = 1;
    tool.push_back(part);
  }
  points.insert(points.end(), more.points.begin(), more.points.end());
}

double shareUnder(const Rect& plate, const Surroundings& surroundings, const Rect& panel) {
  constexpr std::array kAcross{-0.9, -0.45, 0.0, 0.45, 0.9};
  std::array<double, 2> seen{}, under{};
  for (const Surroundings::Part& part : surroundings.tool) {
    const Eigen::Vector2d along = part.to - part.from;
    const double length = along.norm();
    if (length <= 0) continue;
    const Eigen::Vector2d side = Eigen::Vector2d(-along.y(), along.x()) / length * part.half_width;
    for (int i = 0; i < kPlaces; ++i)
      for (const double across : kAcross) {
        const Eigen::Vector2d p = part.from + (i + 0.5) / kPlaces * along + across * side;
        if (!panel.contains(p.x(), p.y())) continue;
        const double area = length * part.half_width;
        seen[part.eye] += area;
        if (plate.contains(p.x(), p.y())) under[part.eye] += area;
      }
  }
  double most = 0;
  for (std::size_t eye = 0; eye < 2; ++eye)
    if (seen[eye] > 0) most = std::max(most, under[eye] / seen[eye]);
  return most;
}

bool isClear(const Rect& plate, const Surroundings& surroundings, const Rect& panel) {
  const bool on_point = std::any_of(
      surroundings.points.begin(), surroundings.points.end(), [&](const Eigen::Vector2d& p) {
        return p.x() > plate.x - kAround_px && p.x() < plate.right() + kAround_px &&
               p.y() > plate.y - kAround_px && p.y() < plate.top() + kAround_px;
      });
  return !on_point && shareUnder(plate, surroundings, panel) <= kMostCovered;
}

Rect mirrored(const Rect& plate, const Rect& panel) {
  return {panel.x + panel.right() - plate.right(), plate.y, plate.width, plate.height};
}

}  // namespace palpa::scene
