#pragma once

#include <array>
#include <optional>
#include <string>
#include <variant>

#include "apps/station/station_file.h"
#include "apps/twin/phantom/layered_phantom.h"

namespace palpa::twin {

/// Of a soft sample under the tool, in W: the force on the tool, N, and where that acts.
struct SampleTouch {
  Vec3 f_W = Vec3::Zero(), p_W = Vec3::Zero();
  std::optional<Vec3> lump_W;  ///< m, how far its lump has moved; none without one
};

/// The soft sample on the virtual bench's table, and a round tip or two on it. W: the world.
class SampleTwin {
 public:
  /// One of the station's simulated samples or objects ("twin/samples", "twin/objects": files of
  /// assets/phantoms without their ending), or the first sample made of another silicone
  /// (assets/materials/surfaces.json); "" is the first sample. Throws UsageError for a station
  /// without samples, or a name that is none of these. `top`: as it was cast; where that is curved,
  /// a sample without a lump is felt with one tool.
  SampleTwin(const station::Station& station, const std::string& name, std::uint64_t seed,
             const TopShape& top = {});

  /// The tool (z along it, T on its end) is there after another `dt`.
  SampleTouch step(const Pose& X_WT, double dt);
  bool forTwo() const { return std::holds_alternative<PhantomFingersTwin>(phantom_); }
  /// Of two tools on a sample without a lump. Throws Error for an object and for a curved top.
  std::array<SampleTouch, 2> step(const std::array<Pose, 2>& X_WT, double dt);

 private:
  double putDown(const station::Station& station, const std::string& name, const TopShape& top);
  Vec3 middleIn(const Pose& X_WT) const;  // of the tip, in P
  Vec3 lowestIn(const Pose& X_WT) const;  // in P
  SampleTouch told(const PhantomTouch& touch, const Vec3& lowest_P) const;

  Pose X_WP_;
  double radius_ = 0;
  bool has_lump_ = false;
  std::variant<std::monostate, PhantomFingersTwin, LayeredPhantomTwin, CurvedPhantomTwin> phantom_;
};

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

/// That object on the virtual bench's stand, which truly stands where the sample truly lies,
/// between two tools with round tips. Its sides are made of the station's first simulated sample.
/// W: the world.
class HeldObjectTwin {
 public:
  /// `X_WO`: where the stand is thought to be. For a station with a sample.
  HeldObjectTwin(const station::Station& station, const HeldObject::Shape& shape, const Pose& X_WO,
                 std::uint64_t seed);

  /// Both tools (z along them, T on their ends) are there after another `dt`.
  std::array<SampleTouch, 2> step(const std::array<Pose, 2>& X_WT, double dt);

 private:
  Pose X_WO_;  ///< as it truly is
  double radius_ = 0;
  HeldObject object_;
};

}  // namespace palpa::twin
