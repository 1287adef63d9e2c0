#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include <Eigen/SparseCholesky>

#include "anatomy/geometry/pose.h"

namespace palpa::anatomy {

using Vec2 = Eigen::Vector2d;

/// A disc of triangles about the origin, finer the nearer to it: `per_ring` nodes on every ring;
/// inside the contact the rings are even, outside each is larger than the one before by the factor
/// that keeps the triangles' shape, so that the number of nodes grows with the logarithm of patch /
/// contact. Metres.
struct GradedDisc {
  int per_ring = 0;
  int contact_rings = 0;      ///< the last of them is the contact's rim
  std::vector<double> radii;  ///< of the rings, from the innermost to the rim
  std::vector<Vec2> nodes;    ///< the centre, then ring by ring, counter-clockwise from +x
  /// counter-clockwise, from the centre outward
  std::vector<std::array<std::uint32_t, 3>> triangles;

  std::uint32_t node(int ring, int k) const {
    return 1 + static_cast<std::uint32_t>(ring * per_ring + k % per_ring);
  }
  int contactTriangles() const { return per_ring * (2 * contact_rings - 1); }

  /// Nodes and weights that interpolate at x: linear across a sector and between two rings. False
  /// beyond the rim.
  struct Place {
    std::array<std::uint32_t, 4> node{};
    std::array<double, 4> weight{};
  };
  bool find(const Vec2& x, Place* place) const;
};

/// `contact` < `patch`: radii; 8 nodes a ring or more.
GradedDisc gradedDisc(double contact, double patch, int per_ring);

/// The skin's surface round a contact: a membrane under tension T on an elastic foundation k (fat
/// and muscle below),
///
///     T laplace(w) - k w = -p     w = 0 on the rim      w: depth along the inward normal, metres
///
/// by linear finite elements on a graded disc. Why a membrane: skin is thin and under tension
/// (Langer's lines), its bending counts only within about its own thickness; why a foundation:
/// without one a dimple would end where the patch does. With it, it falls like K0(r / lambda),
/// lambda = sqrt(T / k). The depth at the contact is prescribed, so only lambda matters, not T and
/// k.
///
/// The equation knows no place: the disc travels with the contact (contact-centred coordinates),
/// and the matrix is factorised once, for the life of the object. A frame is one back-substitution.
/// A point load would be singular (ln r): the load covers a disc of the contact's radius. A tool
/// that leans presses more ahead of it:
///
///     p(x) = p0 (1 + lean . x / a)     |lean| <= 1, a: contact radius
///
/// whose centre lies a lean / 4 ahead.
///
/// Errors: tests/anatomy_deflection holds it against the closed forms. Linear: slopes and depths
/// are taken as small; a dimple deeper than it is wide is drawn, but no longer mechanics.
class SkinDeflection {
 public:
  struct Settings {
    /// Lambda, m; [chosen], no figure found: 10 mm away a dimple is down to a fifth. 0: no
    /// foundation
    double decay = 0.012;
    /// Radius of the load, m; [chosen]: an 18 G needle's 0.6 mm, spread by half the skin's 2 mm
    double contact = 0.0015;
    double patch = 0.060;  ///< radius of the rim, m: five times lambda
    int per_ring = 48;     ///< nodes a ring: 1700 nodes in all; 84: 5000
  };
  explicit SkinDeflection(const Settings& settings);

  /// Solves for a contact of this depth (negative: the skin is drawn out) and lean.
  void update(double depth, const Vec2& lean = Vec2::Zero());

  struct Sample {
    double depth = 0;
    Vec2 slope = Vec2::Zero();  ///< gradient of the depth
  };
  /// Interpolated at x; zero from the rim on.
  Sample at(const Vec2& x) const;

  const GradedDisc& disc() const { return disc_; }
  const Settings& settings() const { return settings_; }
  /// Of the nodes that can move: all but the last ring, in the disc's order.
  const Eigen::SparseMatrix<double>& stiffness() const { return stiffness_; }
  Eigen::VectorXd load(const Vec2& lean) const;  ///< p0 so that the force is T
  Eigen::VectorXd solve(const Eigen::VectorXd& load) const;

 private:
  void assemble();
  void makeLoads();
  void recoverSlopes();

  Settings settings_;
  GradedDisc disc_;
  Eigen::SparseMatrix<double> stiffness_;
  Eigen::SimplicialLDLT<Eigen::SparseMatrix<double>> solver_;
  std::array<Eigen::VectorXd, 3> loads_;  // even, and per unit of lean in x and y
  Eigen::VectorXd load_, depth_;
  std::vector<Vec2> slope_;
  std::vector<double> share_;  // of the area round a node: for the slopes' mean
};

}  // namespace palpa::anatomy
