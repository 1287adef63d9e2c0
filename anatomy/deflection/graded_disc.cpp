#include "anatomy/deflection/graded_disc.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "anatomy/geometry/error.h"

namespace palpa::anatomy {
namespace {

constexpr double kTurn = 2 * std::numbers::pi;

std::vector<double> ringRadii(double contact, double patch, int inner, int per_ring) {
  std::vector<double> radii;
  for (int i = 1; i <= inner; ++i) radii.push_back(contact * i / inner);
  const int outer =
      static_cast<int>(std::ceil(std::log(patch / contact) / std::log1p(kTurn / per_ring)));
  for (int i = 1; i <= outer; ++i)
    radii.push_back(contact * std::pow(patch / contact, double(i) / outer));
  radii.back() = patch;
  return radii;
}

}  // namespace

GradedDisc gradedDisc(double contact, double patch, int per_ring) {
  if (!(contact > 0) || !(patch > contact) || per_ring < 8)
    throw Error("needs 0 < contact < patch and 8 nodes a ring or more", "graded disc",
                "Give other radii");
  GradedDisc disc;
  disc.per_ring = per_ring;
  disc.contact_rings = per_ring / 8;
  disc.radii = ringRadii(contact, patch, disc.contact_rings, per_ring);
  disc.nodes.emplace_back(0, 0);
  for (const double radius : disc.radii)
    for (int k = 0; k < per_ring; ++k)
      disc.nodes.emplace_back(radius * std::cos(kTurn * k / per_ring),
                              radius * std::sin(kTurn * k / per_ring));
  for (int k = 0; k < per_ring; ++k)
    disc.triangles.push_back({0, disc.node(0, k), disc.node(0, k + 1)});
  for (int ring = 1; ring < static_cast<int>(disc.radii.size()); ++ring)
    for (int k = 0; k < per_ring; ++k) {
      const std::uint32_t a = disc.node(ring - 1, k), b = disc.node(ring - 1, k + 1);
      const std::uint32_t c = disc.node(ring, k), d = disc.node(ring, k + 1);
      // Diagonals in turn, so that the mesh has no sense of rotation.
      if ((ring + k) % 2) {
        disc.triangles.push_back({a, c, d});
        disc.triangles.push_back({a, d, b});
      } else {
        disc.triangles.push_back({a, c, b});
        disc.triangles.push_back({b, c, d});
      }
    }
  return disc;
}

bool GradedDisc::find(const Vec2& x, Place* place) const {
  const double angle = std::atan2(x.y(), x.x());
  const int k = std::clamp(
      static_cast<int>(std::floor((angle < 0 ? angle + kTurn : angle) / kTurn * per_ring)), 0,
      per_ring - 1);
  // In a sector the rings are chords: `out` is the radius of the ring whose chord runs through x.
  const double middle = kTurn * (k + 0.5) / per_ring, half = kTurn / (2 * per_ring);
  const Vec2 ahead(std::cos(middle), std::sin(middle)), across(-ahead.y(), ahead.x());
  const double out = x.dot(ahead) / std::cos(half);
  if (!(out < radii.back())) return false;
  const double side =
      out > 0 ? std::clamp(0.5 + 0.5 * x.dot(across) / (out * std::sin(half)), 0.0, 1.0) : 0.5;
  const int ring =
      static_cast<int>(std::upper_bound(radii.begin(), radii.end(), out) - radii.begin());
  const double inner = ring > 0 ? radii[ring - 1] : 0;
  const double part = std::max((out - inner) / (radii[ring] - inner), 0.0);
  place->node = {ring > 0 ? node(ring - 1, k) : 0, ring > 0 ? node(ring - 1, k + 1) : 0,
                 node(ring, k), node(ring, k + 1)};
  place->weight = {(1 - part) * (1 - side), (1 - part) * side, part * (1 - side), part * side};
  return true;
}

}  // namespace palpa::anatomy
