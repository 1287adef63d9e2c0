#pragma once

#include <array>

#include "apps/twin/phantom/phantom_twin.h"

namespace palpa::twin {

/// A mass with a soft side toward each of two tools, on a stand from which it can be lifted: free
/// to move, not to turn. Frame O of the stand: origin in the object's middle while it rests, x from
/// the second tool to the first, z up.
class HeldObject {
 public:
  struct Shape {
    double half = 0.03;  ///< m, from its middle to a side
    double mass = 0.02;  ///< kg
  };
  HeldObject(const Shape& shape, const PhantomTable& side, const SiliconeLaw& law)
      : shape_(shape), sides_{PhantomTwin(side, law), PhantomTwin(side, law)} {}

  /// The tools' innermost points p_O, m, after another `dt`; the object's forces on the tools, N.
  /// `held`: something keeps it where it rests.
  std::array<Vec3, 2> step(const std::array<Vec3, 2>& p_O, double dt, bool held = false);
  const Vec3& place() const { return p_; }  ///< of its middle, m

 private:
  Vec3 onStand() const;
  Shape shape_;
  std::array<PhantomTwin, 2> sides_;
  Vec3 p_ = Vec3::Zero(), v_ = Vec3::Zero();
};

}  // namespace palpa::twin
