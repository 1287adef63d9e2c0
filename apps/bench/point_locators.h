#pragma once

#include <memory>
#include <string>
#include <vector>

#include "anatomy/patient.h"

namespace palpa::bench {

/// Something that finds the point of a mesh nearest to a point.
class PointLocator {
 public:
  virtual ~PointLocator() = default;
  virtual std::string name() const = 0;
  virtual Vec3 closest(const Vec3& p) = 0;
};

/// Ours, which also tells normal and sign; VTK's vtkStaticCellLocator on double points; Embree's
/// point query, where the library walks its tree and calls back for each triangle, whose distance
/// is ours, in double. Embree is left out where it was not there when the program was built
/// (`embreeIsThere`). The mesh has to outlive them.
std::unique_ptr<PointLocator> ourLocator(const anatomy::TriangleMesh& mesh);
std::unique_ptr<PointLocator> vtkLocator(const anatomy::TriangleMesh& mesh);
std::unique_ptr<PointLocator> embreeLocator(const anatomy::TriangleMesh& mesh);
bool embreeIsThere();

}  // namespace palpa::bench
