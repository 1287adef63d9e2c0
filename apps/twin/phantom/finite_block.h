#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "anatomy/geometry/pose.h"

/// What pressing a block of silicone takes: finite elements, large displacements. The truth about
/// simulated phantoms; nothing that renders forces may see it.
namespace palpa::twin {

/// A block on a plate to which it is glued, or in a frame to which its sides are glued. Frame P:
/// origin in the middle of its top, z up, so that the block lies at z < 0.
struct SoftBlock {
  double length = 0.10, width = 0.10, height = 0.05;  ///< m, along x, y, z
  double shear = 2.4e3;                               ///< Pa, of small strains
  double bulk_over_shear = 50;                        ///< 50: Poisson's ratio 0.49
  bool framed = false;  ///< held all round, free above and below; else on a plate
  struct Lump {
    Vec3 centre{0, 0, -0.015};            ///< m; y = 0
    double radius = 0.008, shear = 24e3;  ///< m, Pa
  };
  std::optional<Lump> lump;

  /// From the top down, as thick as `thickness` in the middle, and `slope` more for every metre
  /// along x: skin over fat over the rest.
  struct Layer {
    double thickness = 2e-3, slope = 0, shear = 8e3;  ///< m, m/m, Pa
  };
  std::vector<Layer> layers;
  /// Round bars along y from side to side: ribs.
  struct Rib {
    double x = 0, z = -0.02, radius = 0.006, shear = 60e3;  ///< m, m, m, Pa
  };
  std::vector<Rib> ribs;
};

/// Pa, at a point: of the lump; else of the rib; else of the layer; else the block's.
double shearAt(const SoftBlock& block, const Vec3& p);

/// How fine the elements are where a tool presses, and how they grow from there.
struct Fineness {
  double finest = 2e-3, growth = 0.35, coarsest = 12e-3;  ///< m, m/m, m
};

/// What a block does under its tools.
struct BlockResponse {
  std::vector<Vec3> f;       ///< N, of the block on each tool
  Vec3 lump = Vec3::Zero();  ///< m, how far the lump has moved: mean over its volume
  double under = 0;   ///< m, how far up the block's lower face has moved under the first tool
  double energy = 0;  ///< J
  int iterations = 0;
};

/// What of a block is computed: half of it where the tools press in its plane y = 0, and all that
/// it holds is the same on both sides of it; else the whole.
enum class BlockPart { half, whole };

/// The block under one or two round, frictionless tool tips. Hexahedra with mean dilatation (Simo,
/// Taylor and Pister 1985), which do not lock; neo-Hookean; contact by a penalty, integrated over
/// the surface; Newton's method with steps halved until the energy falls.
class FiniteBlock {
 public:
  /// `tool_x`: where tools will press, in y = 0, about which elements are fine.
  FiniteBlock(const SoftBlock& block, const std::vector<double>& tool_x, double tool_radius,
              const Fineness& fineness = {});
  /// The whole block under one tool that will press at `tool`, (x, y).
  static FiniteBlock whole(const SoftBlock& block, const Eigen::Vector2d& tool, double tool_radius,
                           const Fineness& fineness = {});
  FiniteBlock(FiniteBlock&&) noexcept;
  ~FiniteBlock();

  /// At rest with the tools' lowest points at `tips`; starts from the last answer. Of a block in a
  /// frame the second tool presses from below: its highest point. Throws Error where it finds no
  /// equilibrium.
  BlockResponse press(const std::vector<Vec3>& tips);
  void release();  ///< as it was made

 private:
  struct Model;
  explicit FiniteBlock(std::unique_ptr<Model> model);
  std::unique_ptr<Model> model_;
};

}  // namespace palpa::twin
