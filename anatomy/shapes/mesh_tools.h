#pragma once

#include <functional>
#include <vector>

#include "anatomy/patient.h"

namespace palpa::anatomy {

/// Area-weighted vertex normals from the triangles.
void computeNormals(TriangleMesh* mesh);

/// Turns every triangle round.
void flip(TriangleMesh* mesh);

/// The mirror image across x = 0, still facing outward.
TriangleMesh mirroredMesh(TriangleMesh mesh);

/// Volume enclosed by a closed mesh; positive when the triangles face outward.
double signedVolume(const TriangleMesh& mesh);

/// Every edge is shared by exactly two triangles that run along it in opposite directions.
bool isClosed(const TriangleMesh& mesh);

/// A point of a sheet's middle surface, its unit normal, and how far the sheet reaches to either
/// side; both halves 0 on the border.
struct SheetPoint {
  Vec3 middle, normal;
  double front, back;
};

/// Closed mesh of a sheet over the unit square, `along` x `across` quads a side.
TriangleMesh sheet(const std::function<SheetPoint(double u, double v)>& at, int along, int across);

/// One cross-section of a swept tube: an ellipse across `tangent`.
struct Section {
  Vec3 centre;
  Vec3 tangent;  ///< unit
  Vec3 up;       ///< unit, across the tangent: direction of `half_up`
  double half_up;
  double half_side;
};

/// Closed tube through the sections with rounded ends (half ellipsoids, `bulge` times the mean
/// half-axis long), `around` vertices a ring.
TriangleMesh sweep(const std::vector<Section>& sections, int around, double bulge);

/// Sections along a chain of points; `up` is made square to the tangent at each.
std::vector<Section> sectionsAlong(const std::vector<Vec3>& centres, const Vec3& up);

}  // namespace palpa::anatomy
