#pragma once

#include <type_traits>

#include "anatomy/geometry/local_geometry.h"
#include "haptics/materials/force_laws.h"

namespace palpa::haptics {

/// With what a tool presses on the skin.
enum class ToolShape : std::uint8_t { point, line, flat };

/// K_0 of a line or a flat side in that of a point: about 2 and 4. Source: Tzafestas et al.,
/// Presence 17(2), 2008.
constexpr double loadOf(ToolShape shape) {
  return shape == ToolShape::point ? 1 : shape == ToolShape::line ? 2 : 4;
}

/// Skin before puncture, indentation u along the inward normal [m]; point load:
///     K(u) = K_min                                u <= u_0
///     K(u) = K_0 (exp(m (u - u_0)) - 1) + K_min   u >  u_0        F = K(u) u
/// Source: Tzafestas et al., Presence 17(2), 2008.
struct SkinLaw {
  double K_min = 0;            ///< N/m
  double K_0 = 10;             ///< N/m
  double m = 2000;             ///< 1/m
  double u_0 = 0.0001;         ///< m
  double release_tau = 0.010;  ///< s, decay of the stored indentation after the puncture
  double friction = 0.3;       ///< Coulomb coefficient, needle point sliding on the skin
  double shear = 300;          ///< N/m, skin dragged sideways by the point before it slides
  Relaxation relaxation;       ///< of the indented skin

  double force(double u) const;      ///< F(u), 0 for u <= 0 [N]
  double stiffness(double u) const;  ///< dF/du [N/m]
};

/// What the needle feels in one tissue (after Okamura, Simone, O'Leary, IEEE TBME 51(10), 2004).
struct LayerLaw {
  double viscosity = 0;  ///< b, N s/m, on the tip's axial velocity
  double cutting = 0;    ///< N, constant while advancing
  double friction = 0;   ///< N/m, shaft friction per inserted length
};

/// Wall that must be punctured: elastic and relaxing, up to `peak`, then it gives way.
struct WallLaw {
  double stiffness = 0;  ///< N/m
  double peak = 0;       ///< N, median over patients and places; 0: no wall
  double spread = 0;     ///< of ln(peak) from trial to trial, standard deviation
  Relaxation relaxation;
};

struct NeedleMaterials {
  SkinLaw skin;
  LayerLaw layers[kTissueCount];
  WallLaw walls[kOrganCount];
  double lateral_stiffness = 300;   ///< k_t of the tissue about the entry, N/m
  double lateral_per_depth = 4000;  ///< more with inserted length, N/m per m
  double needle_radius = 0.000635;  ///< 18G: outer diameter 1.27 mm
  double needle_length = 0.070;
};
static_assert(std::is_trivially_copyable_v<NeedleMaterials>);

/// Walls already punctured, a bit per Organ.
struct PuncturedWalls {
  std::uint32_t front = 0, back = 0;
};

/// What the tip and the shaft are in, walking the boundaries from the skin inward.
struct TissueWalk {
  Tissue tissue = Tissue::skin;
  double shaft_friction = 0;  ///< N: sum over layers of friction per length x length
  double wall_depth = 0;      ///< m: how far the tip has pushed an intact wall
  Organ wall = Organ::none;
  bool wall_leaving = false;
  PuncturedWalls passed;  ///< walls that are punctured and still around the needle
};

/// `insertion`: length of needle under the skin. A wall that is not in `walls` stops the walk: the
/// tip is still before it, pushing. A wall is forgotten when the tip is 0.3 mm back out of it.
TissueWalk walkTissues(const NeedleMaterials& materials, const LocalGeometry& geometry,
                       const Vec3& p_DT, const Vec3& a_D, double insertion,
                       const PuncturedWalls& walls) noexcept;

}  // namespace palpa::haptics
