#include "anatomy/deflection/skin_deflection.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "anatomy/base/error.h"

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

namespace {

/// A triangle's area and the gradients of its three linear functions.
struct Element {
  double area;
  std::array<Vec2, 3> gradient;
};

Element elementOf(const GradedDisc& disc, const std::array<std::uint32_t, 3>& t) {
  const Vec2 &a = disc.nodes[t[0]], &b = disc.nodes[t[1]], &c = disc.nodes[t[2]];
  const double twice = (b - a).x() * (c - a).y() - (b - a).y() * (c - a).x();
  const auto turned = [twice](const Vec2& edge) { return Vec2(Vec2(-edge.y(), edge.x()) / twice); };
  return {twice / 2, {turned(c - b), turned(a - c), turned(b - a)}};
}

}  // namespace

SkinDeflection::SkinDeflection(const Settings& settings)
    : settings_(settings), disc_(gradedDisc(settings.contact, settings.patch, settings.per_ring)) {
  assemble();
  makeLoads();
  solver_.compute(stiffness_);
  if (solver_.info() != Eigen::Success)
    throw Error("has no solution", "skin deflection", "Give other radii");
  const auto all = static_cast<Eigen::Index>(disc_.nodes.size());
  load_ = Eigen::VectorXd::Zero(stiffness_.rows());
  depth_ = Eigen::VectorXd::Zero(all);
  slope_.assign(disc_.nodes.size(), Vec2::Zero());
}

void SkinDeflection::assemble() {
  const auto free =
      static_cast<std::uint32_t>(disc_.nodes.size()) - static_cast<std::uint32_t>(disc_.per_ring);
  const double k =
      settings_.decay > 0 ? 1 / (settings_.decay * settings_.decay) : 0;  // in units of T
  std::vector<Eigen::Triplet<double>> entries;
  entries.reserve(9 * disc_.triangles.size());
  share_.assign(disc_.nodes.size(), 0);
  for (const auto& t : disc_.triangles) {
    const Element e = elementOf(disc_, t);
    for (int i = 0; i < 3; ++i) {
      share_[t[i]] += e.area;
      for (int j = 0; j < 3; ++j) {
        if (t[i] >= free || t[j] >= free) continue;
        const double mass = e.area / 12 * (i == j ? 2 : 1);
        entries.emplace_back(t[i], t[j], e.area * e.gradient[i].dot(e.gradient[j]) + k * mass);
      }
    }
  }
  stiffness_.resize(free, free);
  stiffness_.setFromTriplets(entries.begin(), entries.end());
}

void SkinDeflection::makeLoads() {
  for (Eigen::VectorXd& load : loads_) load = Eigen::VectorXd::Zero(stiffness_.rows());
  double area = 0;
  for (int i = 0; i < disc_.contactTriangles(); ++i) {
    const auto& t = disc_.triangles[i];
    const Element e = elementOf(disc_, t);
    area += e.area;
    for (int a = 0; a < 3; ++a)
      for (int b = 0; b < 3; ++b) {
        const double mass = e.area / 12 * (a == b ? 2 : 1);
        loads_[0][t[a]] += mass;
        loads_[1][t[a]] += mass * disc_.nodes[t[b]].x() / settings_.contact;
        loads_[2][t[a]] += mass * disc_.nodes[t[b]].y() / settings_.contact;
      }
  }
  for (Eigen::VectorXd& load : loads_) load /= area;
}

Eigen::VectorXd SkinDeflection::load(const Vec2& lean) const {
  return loads_[0] + lean.x() * loads_[1] + lean.y() * loads_[2];
}

Eigen::VectorXd SkinDeflection::solve(const Eigen::VectorXd& load) const {
  return solver_.solve(load);
}

void SkinDeflection::update(double depth, const Vec2& lean) {
  const Vec2 most = lean.norm() > 1 ? Vec2(lean.normalized()) : lean;
  load_ = loads_[0];
  load_ += most.x() * loads_[1];
  load_ += most.y() * loads_[2];
  auto moving = depth_.head(load_.size());
  moving = solver_.solve(load_);
  depth_ *= depth / depth_[0];
  recoverSlopes();
}

/// Means of the slopes of the triangles round a node, by area.
void SkinDeflection::recoverSlopes() {
  std::fill(slope_.begin(), slope_.end(), Vec2::Zero());
  for (const auto& t : disc_.triangles) {
    const Element e = elementOf(disc_, t);
    Vec2 slope = Vec2::Zero();
    for (int i = 0; i < 3; ++i) slope += depth_[t[i]] * e.gradient[i];
    for (const std::uint32_t node : t) slope_[node] += e.area * slope;
  }
  for (std::size_t i = 0; i < slope_.size(); ++i) slope_[i] /= share_[i];
}

SkinDeflection::Sample SkinDeflection::at(const Vec2& x) const {
  GradedDisc::Place place;
  Sample sample;
  if (!disc_.find(x, &place)) return sample;
  for (int i = 0; i < 4; ++i) {
    sample.depth += place.weight[i] * depth_[place.node[i]];
    sample.slope += place.weight[i] * slope_[place.node[i]];
  }
  return sample;
}

}  // namespace palpa::anatomy
