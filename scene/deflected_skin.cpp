#include "scene/deflected_skin.h"

#include <vtkFloatArray.h>
#include <vtkPointData.h>
#include <vtkPoints.h>
#include <vtkPolyData.h>

#include <algorithm>

namespace palpa::scene {
namespace {

float* floatsOf(vtkDataArray* array) {
  vtkFloatArray* floats = vtkFloatArray::SafeDownCast(array);
  return floats ? floats->GetPointer(0) : nullptr;
}

void put(const Vec3& from, float* to) {
  for (int axis = 0; axis < 3; ++axis) to[axis] = static_cast<float>(from[axis]);
}

}  // namespace

DeflectedSkin::DeflectedSkin(const anatomy::TriangleMesh& mesh, vtkPolyData& drawn)
    : dimple_(mesh),
      drawn_(drawn),
      points_(floatsOf(drawn.GetPoints()->GetData())),
      normals_(floatsOf(drawn.GetPointData()->GetNormals())) {}

void DeflectedSkin::restore() {
  for (const Before& was : before_) {
    std::copy(was.p.begin(), was.p.end(), points_ + 3 * std::size_t{was.index});
    if (normals_) std::copy(was.n.begin(), was.n.end(), normals_ + 3 * std::size_t{was.index});
  }
  before_.clear();
}

void DeflectedSkin::update(const std::optional<anatomy::SkinPush>& push) {
  if (!push && before_.empty()) return;
  restore();
  if (push) {
    for (const anatomy::SkinDimple::Vertex& moved : dimple_.press(*push)) {
      float* p = points_ + 3 * std::size_t{moved.index};
      float* n = normals_ ? normals_ + 3 * std::size_t{moved.index} : nullptr;
      Before was{moved.index, {p[0], p[1], p[2]}, {}};
      put(moved.p_A, p);
      if (n) {
        was.n = {n[0], n[1], n[2]};
        put(moved.n_A, n);
      }
      before_.push_back(was);
    }
  }
  drawn_.GetPoints()->GetData()->Modified();
  drawn_.GetPoints()->Modified();
  if (normals_) drawn_.GetPointData()->GetNormals()->Modified();
  drawn_.Modified();
}

}  // namespace palpa::scene
