#include "anatomy/deflection/skin_deflection.h"

#include <algorithm>

#include "anatomy/geometry/error.h"

namespace palpa::anatomy {
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
