#include "apps/twin/phantom/finite_block.h"

#include <Eigen/SparseCholesky>
#include <algorithm>
#include <cmath>

#include "anatomy/base/error.h"
#include "apps/twin/phantom/finite_elements.h"

namespace palpa::twin {
namespace {

constexpr int kMostNewton = 60, kMostHalvings = 12, kMostGradients = 60;
constexpr double kStepWithin = 2e-2;  // of the gradient: Newton's next step sees the rest
constexpr double kGoodEnough = 1e-6;  // of the force on the tools
// Of the tip's cover, in Young's moduli per finest element: it gives by some hundredths of a
// millimetre
constexpr double kTipStiffness = 40;
constexpr double kLongestStep = 1.6e-3;  // m that tools go at once

bool inLump(const SoftBlock& block, const Vec3& p) {
  return block.lump && (p - block.lump->centre).norm() < block.lump->radius;
}

/// What a Gauss point's eighth of an element holds. The elements are boxes.
struct Held {
  double lump = 0;   ///< share of it that lies in the lump
  double shear = 0;  ///< Pa, on average
};
Held heldBy(const SoftBlock& block, const Brick::IntegrationPoint& point,
            const std::array<Eigen::Vector3d, 8>& nodes) {
  constexpr int kEach = 6, kAll = kEach * kEach * kEach;
  const Vec3 middle = 0.5 * (nodes[0] + nodes[6]), half = 0.5 * (nodes[6] - nodes[0]);
  Held held;
  for (int i = 0; i < kAll; ++i) {
    const Vec3 share((i % kEach + 0.5) / kEach, (i / kEach % kEach + 0.5) / kEach,
                     (i / kEach / kEach + 0.5) / kEach);
    const Vec3 p = middle + share.cwiseProduct(half).cwiseProduct((point.p - middle).cwiseSign());
    held.lump += inLump(block, p);
    held.shear += shearAt(block, p);
  }
  return {held.lump / kAll, held.shear / kAll};
}

}  // namespace

double shearAt(const SoftBlock& block, const Vec3& p) {
  if (inLump(block, p)) return block.lump->shear;
  for (const SoftBlock::Rib& rib : block.ribs)
    if (std::hypot(p.x() - rib.x, p.z() - rib.z) < rib.radius) return rib.shear;
  double below = 0;  // m, down to a layer's lower side
  for (const SoftBlock::Layer& layer : block.layers)
    if (-p.z() < (below += layer.thickness + layer.slope * p.x())) return layer.shear;
  return block.shear;
}

struct FiniteBlock::Model {
  BlockPart part = BlockPart::half;
  BlockMesh mesh;
  double tool_radius, cover;
  bool framed = false;
  std::vector<Brick> bricks;
  std::vector<double> bulk;
  std::vector<int> unknown;       // of a coordinate of a node; -1: fixed
  Eigen::VectorXd u, lump_share;  // per node: its share of the lump's mean displacement
  std::vector<Vec3> tips;         // of the last answer; none: unloaded
  Eigen::SimplicialLDLT<Eigen::SparseMatrix<double>> solver;
  bool factored = false;
  int count = 0;

  bool fromBelow(std::size_t tool) const { return framed && tool == 1; }

  /// How far up the lower face has moved at (x, 0), m.
  double under(double x) const {
    for (const std::array<int, 4>& face : mesh.bottom) {
      const Vec3 &from = mesh.nodes[face[0]], &to = mesh.nodes[face[1]];
      if (from.y() != 0 || x < from.x() || x > to.x()) continue;
      const double share = (x - from.x()) / (to.x() - from.x());
      return (1 - share) * u[3 * face[0] + 2] + share * u[3 * face[1] + 2];
    }
    return 0;
  }

  /// Of the whole block, where half of it is computed.
  Vec3 of(const Vec3& sum) const {
    return part == BlockPart::whole ? sum : Vec3(2 * sum.x(), 0, 2 * sum.z());
  }
  double of(double sum) const { return part == BlockPart::whole ? sum : 2 * sum; }

  Vec24 of(const std::array<int, 8>& brick) const {
    Vec24 local;
    for (int a = 0; a < 8; ++a) local.segment<3>(3 * a) = u.segment<3>(3 * brick[a]);
    return local;
  }

  struct BlockState {
    bool possible = true;
    double E = 0;
    Eigen::VectorXd gradient;  // by the unknowns
    std::vector<Vec3> f_tips;
  };

  /// Scatters a small matrix into the triplets of the large one, its lower half.
  template <class Nodes, class Local>
  void scatter(const Nodes& nodes, const Local& local,
               std::vector<Eigen::Triplet<double>>* out) const {
    for (int r = 0; r < local.rows(); ++r) {
      const int row = unknown[3 * nodes[r / 3] + r % 3];
      if (row < 0) continue;
      for (int c = 0; c < local.cols(); ++c) {
        const int column = unknown[3 * nodes[c / 3] + c % 3];
        if (column >= 0 && column <= row) out->emplace_back(row, column, local(r, c));
      }
    }
  }
  template <class Nodes, class Local>
  void add(const Nodes& nodes, const Local& local, Eigen::VectorXd* gradient) const {
    for (int r = 0; r < local.rows(); ++r) {
      const int row = unknown[3 * nodes[r / 3] + r % 3];
      if (row >= 0) (*gradient)[row] += local[r];
    }
  }

  BlockState evaluate(const std::vector<Vec3>& at,
                      std::vector<Eigen::Triplet<double>>* tangent) const {
    BlockState state;
    state.gradient = Eigen::VectorXd::Zero(count);
    state.f_tips.assign(at.size(), Vec3::Zero());
    Mat24 K;
    Vec24 g;
    for (std::size_t b = 0; b < bricks.size(); ++b) {
      double E = 0;
      if (!energyOf(bricks[b], bulk[b], of(mesh.bricks[b]), &E, &g, tangent ? &K : nullptr))
        return {false, 0, {}, {}};
      state.E += E;
      add(mesh.bricks[b], g, &state.gradient);
      if (tangent) scatter(mesh.bricks[b], K, tangent);
    }
    for (std::size_t t = 0; t < at.size(); ++t) touch(at[t], t, &state, tangent);
    return state;
  }

  void touch(const Vec3& tip, std::size_t t, BlockState* state,
             std::vector<Eigen::Triplet<double>>* tangent) const {
    const RoundTip round{tip + Vec3(0, 0, fromBelow(t) ? -tool_radius : tool_radius), tool_radius};
    for (const std::array<int, 4>& face : fromBelow(t) ? mesh.bottom : mesh.top) {
      std::array<Vec3, 4> before, now;
      for (int a = 0; a < 4; ++a) {
        before[a] = mesh.nodes[face[a]];
        now[a] = before[a] + u.segment<3>(3 * face[a]);
      }
      const FacePressure pressure = pressureOn(before, now, round, cover);
      if (!pressure.touches) continue;
      state->E += pressure.E;
      add(face, pressure.gradient, &state->gradient);
      if (tangent) scatter(face, pressure.tangent, tangent);
      state->f_tips[t] += of(pressure.f_tip);
    }
  }

  void move(const Eigen::VectorXd& step, double share) {
    for (std::size_t i = 0; i < unknown.size(); ++i) {
      if (unknown[i] >= 0) u[static_cast<Eigen::Index>(i)] += share * step[unknown[i]];
    }
  }

  /// Newton's step: conjugate gradients, preconditioned by the factors of an earlier matrix, which
  /// are made anew where they do not serve (any more).
  Eigen::VectorXd newtonStep(std::vector<Eigen::Triplet<double>> tangent,
                             const Eigen::VectorXd& gradient) {
    Eigen::SparseMatrix<double> K(count, count);
    for (int i = 0; i < count; ++i) tangent.emplace_back(i, i, 0.0);
    K.setFromTriplets(tangent.begin(), tangent.end());
    if (factored) {
      if (const auto step = byOldFactors(K, gradient)) return *step;
    }
    factor(K);
    if (const auto step = byOldFactors(K, gradient)) return *step;
    return solver.solve(-gradient);  // of a matrix that had to be shifted: still downhill
  }

  /// Factors of K, shifted where it is not positive definite.
  void factor(Eigen::SparseMatrix<double> K) {
    if (!factored) solver.analyzePattern(K);
    factored = true;
    solver.factorize(K);
    for (double shift = 1e-3 * K.diagonal().mean();
         solver.info() != Eigen::Success || solver.vectorD().minCoeff() <= 0; shift *= 4) {
      for (int i = 0; i < count; ++i) K.coeffRef(i, i) += shift;
      solver.factorize(K);
    }
  }

  /// Nothing where that takes too long, or K is not positive definite along the way.
  std::optional<Eigen::VectorXd> byOldFactors(const Eigen::SparseMatrix<double>& K,
                                              const Eigen::VectorXd& gradient) const {
    const auto lower = K.selfadjointView<Eigen::Lower>();
    Eigen::VectorXd x = Eigen::VectorXd::Zero(count), r = -gradient, z = solver.solve(r), p = z;
    double rz = r.dot(z);
    for (int i = 0; i < kMostGradients; ++i) {
      const Eigen::VectorXd Kp = lower * p;
      const double curvature = p.dot(Kp);
      if (!(curvature > 0) || !(rz > 0)) return std::nullopt;
      x += rz / curvature * p;
      r -= rz / curvature * Kp;
      if (r.norm() < kStepWithin * gradient.norm()) return x;
      z = solver.solve(r);
      const double next = r.dot(z);
      p = z + next / rz * p;
      rz = next;
    }
    return std::nullopt;
  }

  BlockResponse settle(const std::vector<Vec3>& at);
  /// Of `mesh`: its elements, what they hold, what is unknown.
  void fill(const SoftBlock& block, double radius, const Fineness& fineness);
};

BlockResponse FiniteBlock::Model::settle(const std::vector<Vec3>& at) {
  BlockResponse answer;
  for (; answer.iterations < kMostNewton; ++answer.iterations) {
    std::vector<Eigen::Triplet<double>> tangent;
    const BlockState here = evaluate(at, &tangent);
    if (!here.possible) break;
    double force = 1e-3;
    for (const Vec3& f : here.f_tips) force = std::max(force, f.norm());
    if (here.gradient.norm() < kGoodEnough * force) {
      answer.f = here.f_tips;
      answer.energy = of(here.E);
      for (std::size_t a = 0; a < mesh.nodes.size(); ++a)
        answer.lump += lump_share[static_cast<Eigen::Index>(a)] *
                       u.segment<3>(3 * static_cast<Eigen::Index>(a));
      if (part == BlockPart::half) answer.lump.y() = 0;
      answer.under = under(at.front().x());
      return answer;
    }
    const Eigen::VectorXd step = newtonStep(std::move(tangent), here.gradient);
    const double falls = step.dot(here.gradient);
    double share = 1;
    move(step, share);
    for (int h = 0; h < kMostHalvings; ++h) {
      const BlockState there = evaluate(at, nullptr);
      if (there.possible && there.E <= here.E + 1e-4 * share * falls + 1e-12 * std::abs(here.E))
        break;
      move(step, -share / 2);
      share /= 2;
    }
  }
  throw Error("no equilibrium of the block under the tools", "phantom",
              "press less deeply, or use finer elements");
}

void FiniteBlock::Model::fill(const SoftBlock& block, double radius, const Fineness& fineness) {
  Model& m = *this;
  m.tool_radius = radius;
  m.framed = block.framed;
  m.cover = kTipStiffness * 3 * shearAt(block, Vec3::Zero()) / fineness.finest;
  m.u = Eigen::VectorXd::Zero(3 * static_cast<Eigen::Index>(m.mesh.nodes.size()));
  m.lump_share = Eigen::VectorXd::Zero(static_cast<Eigen::Index>(m.mesh.nodes.size()));
  for (const bool fixed : m.mesh.fixed) m.unknown.push_back(fixed ? -1 : m.count++);
  for (const std::array<int, 8>& nodes : m.mesh.bricks) {
    std::array<Eigen::Vector3d, 8> at;
    for (int a = 0; a < 8; ++a) at[a] = m.mesh.nodes[nodes[a]];
    Brick brick = brickOf(at);
    double mean = 0;
    for (Brick::IntegrationPoint& point : brick.points) {
      const Held held = heldBy(block, point, at);
      point.shear = held.shear;
      mean += point.shear * point.volume / brick.volume;
      for (int a = 0; a < 8; ++a) m.lump_share[nodes[a]] += held.lump * point.N[a] * point.volume;
    }
    m.bulk.push_back(block.bulk_over_shear * mean);
    m.bricks.push_back(brick);
  }
  if (const double whole = m.lump_share.sum(); whole > 0) m.lump_share /= whole;
}

FiniteBlock::FiniteBlock(const SoftBlock& block, const std::vector<double>& tool_x,
                         double tool_radius, const Fineness& fineness)
    : model_(std::make_unique<Model>()) {
  model_->mesh = meshOf(block, {tool_x, 0, BlockPart::half}, tool_radius, fineness);
  model_->fill(block, tool_radius, fineness);
}

FiniteBlock FiniteBlock::whole(const SoftBlock& block, const Eigen::Vector2d& tool,
                               double tool_radius, const Fineness& fineness) {
  auto model = std::make_unique<Model>();
  model->part = BlockPart::whole;
  model->mesh = meshOf(block, {{tool.x()}, tool.y(), BlockPart::whole}, tool_radius, fineness);
  model->fill(block, tool_radius, fineness);
  return FiniteBlock(std::move(model));
}

FiniteBlock::FiniteBlock(std::unique_ptr<Model> model) : model_(std::move(model)) {}
FiniteBlock::FiniteBlock(FiniteBlock&&) noexcept = default;
FiniteBlock::~FiniteBlock() = default;

BlockResponse FiniteBlock::press(const std::vector<Vec3>& tips) {
  Model& m = *model_;
  std::vector<Vec3> from = m.tips;
  if (from.size() != tips.size()) {
    from = tips;
    for (std::size_t t = 0; t < from.size(); ++t)
      from[t].z() = m.fromBelow(t) ? std::min(m.mesh.nodes.front().z(), tips[t].z())
                                   : std::max(0.0, tips[t].z());
  }
  double longest = 0;
  for (std::size_t t = 0; t < tips.size(); ++t)
    longest = std::max(longest, (tips[t] - from[t]).norm());
  const int steps = std::max(1, static_cast<int>(std::ceil(longest / kLongestStep)));
  BlockResponse answer;
  for (int s = 1; s <= steps; ++s) {
    std::vector<Vec3> at = from;
    for (std::size_t t = 0; t < tips.size(); ++t) at[t] += (tips[t] - from[t]) * s / steps;
    const int before = answer.iterations;
    answer = m.settle(at);
    answer.iterations += before;
  }
  m.tips = tips;
  return answer;
}

void FiniteBlock::release() {
  model_->u.setZero();
  model_->tips.clear();
}

}  // namespace palpa::twin
