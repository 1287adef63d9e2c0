#include "anatomy/import/decimate.h"

#include <vtkCellArray.h>
#include <vtkDecimatePro.h>
#include <vtkNew.h>
#include <vtkPoints.h>
#include <vtkPolyData.h>
#include <vtkQuadricDecimation.h>

#include <cmath>

#include "anatomy/import/repair.h"
#include "anatomy/import/surface_topology.h"
#include "anatomy/query/triangle_tree.h"
#include "anatomy/shapes/mesh_tools.h"

namespace palpa::anatomy {
namespace {

constexpr int kMendingRounds = 4;
constexpr double kVtkScale = 1e3;  // millimetres: VTK's thresholds are made for numbers about one

vtkSmartPointer<vtkPolyData> toVtk(const TriangleMesh& mesh) {
  vtkNew<vtkPoints> points;
  points->SetDataTypeToDouble();
  for (const Vec3& p : mesh.points) points->InsertNextPoint((kVtkScale * p).eval().data());
  vtkNew<vtkCellArray> cells;
  for (const auto& t : mesh.triangles) {
    const vtkIdType corners[] = {t[0], t[1], t[2]};
    cells->InsertNextCell(3, corners);
  }
  auto data = vtkSmartPointer<vtkPolyData>::New();
  data->SetPoints(points);
  data->SetPolys(cells);
  return data;
}

/// Only points that a triangle uses.
TriangleMesh fromVtk(vtkPolyData& data) {
  TriangleMesh mesh;
  constexpr std::uint32_t kUnused = 0xffffffffu;
  std::vector<std::uint32_t> number(static_cast<std::size_t>(data.GetNumberOfPoints()), kUnused);
  vtkNew<vtkIdList> corners;
  for (data.GetPolys()->InitTraversal(); data.GetPolys()->GetNextCell(corners);) {
    if (corners->GetNumberOfIds() != 3) continue;
    std::array<std::uint32_t, 3> t{};
    for (vtkIdType k = 0; k < 3; ++k) {
      const vtkIdType at = corners->GetId(k);
      std::uint32_t& n = number[static_cast<std::size_t>(at)];
      if (n == kUnused) {
        n = static_cast<std::uint32_t>(mesh.points.size());
        mesh.points.push_back(Vec3(data.GetPoint(at)) / kVtkScale);
      }
      t[static_cast<std::size_t>(k)] = n;
    }
    mesh.triangles.push_back(t);
  }
  return mesh;
}

template <class Filter>
TriangleMesh through(Filter& filter, const TriangleMesh& mesh, double reduction) {
  filter.SetInputData(toVtk(mesh));
  filter.SetTargetReduction(reduction);
  filter.Update();
  return fromVtk(*filter.GetOutput());
}

TriangleMesh byQuadrics(const TriangleMesh& mesh, double reduction) {
  vtkNew<vtkQuadricDecimation> filter;
  filter->VolumePreservationOn();
  return through(*filter, mesh, reduction);
}

/// Without the triangles of edges that have more than two.
void clearCrowdedEdges(RawMesh* mesh) {
  const Edges edges = edgesOf(mesh->triangles);
  std::erase_if(mesh->triangles, [&](const Triangle& t) {
    for (std::size_t k = 0; k < 3; ++k) {
      const EdgeUses& uses = edges.at(edgeKey(t[k], t[(k + 1) % 3]));
      if (uses.forth + uses.back > 2) return true;
    }
    return false;
  });
}

/// Quadrics may fold a thin sheet onto itself: what is folded is taken out and the hole closed.
TriangleMesh byQuadricsMended(const TriangleMesh& mesh, double reduction) {
  TriangleMesh coarse = byQuadrics(mesh, reduction);
  RawMesh raw{"", coarse.points, coarse.triangles};
  for (int round = 0; round < kMendingRounds && !checkSurface(raw).sound(); ++round) {
    clearCrowdedEdges(&raw);
    RepairReport report;
    raw = repaired(raw, &report);
  }
  coarse.points = raw.points;
  coarse.triangles = raw.triangles;
  return coarse;
}

TriangleMesh byTopology(const TriangleMesh& mesh, double reduction) {
  vtkNew<vtkDecimatePro> filter;
  filter->PreserveTopologyOn();
  filter->SplittingOff();
  filter->BoundaryVertexDeletionOff();
  return through(*filter, mesh, reduction);
}

bool asGoodAs(const TriangleMesh& original, const TriangleMesh& result) {
  if (result.triangles.size() < 4 || result.triangles.size() > original.triangles.size())
    return false;
  for (const Vec3& p : result.points)
    if (!p.allFinite()) return false;
  if (!isClosed(original)) return true;
  return isClosed(result) && signedVolume(original) * signedVolume(result) > 0;
}

void measure(const TriangleMesh& original, const TriangleMesh& result, DecimationReport* report) {
  const TriangleTree tree(result);
  double squares = 0;
  for (const Vec3& p : original.points) {
    const double distance = std::abs(tree.closest(p).signed_distance);
    report->farthest = std::max(report->farthest, distance);
    squares += distance * distance;
  }
  report->rms = std::sqrt(squares / static_cast<double>(original.points.size()));
}

}  // namespace

void computeUnitNormals(TriangleMesh* mesh) {
  computeNormals(mesh);
  for (Vec3& n : mesh->normals)
    if (!(std::abs(n.norm() - 1) < 1e-6)) n = Vec3::UnitZ();
}

TriangleMesh decimated(const TriangleMesh& mesh, std::size_t triangles, DecimationReport* report) {
  *report = {mesh.triangles.size(), mesh.triangles.size(), 0, 0, "none"};
  TriangleMesh result = mesh;
  if (mesh.triangles.size() > triangles) {
    const double reduction =
        1 - static_cast<double>(triangles) / static_cast<double>(mesh.triangles.size());
    const std::pair<const char*, TriangleMesh (*)(const TriangleMesh&, double)> ways[] = {
        {"quadrics", byQuadrics},
        {"quadrics, mended", byQuadricsMended},
        {"edges kept manifold", byTopology}};
    for (const auto& [name, way] : ways) {
      TriangleMesh found = way(mesh, reduction);
      if (!asGoodAs(mesh, found)) continue;
      result = std::move(found);
      report->way = name;
      break;
    }
  }
  computeUnitNormals(&result);
  report->after = result.triangles.size();
  if (report->way != "none") measure(mesh, result, report);
  return result;
}

}  // namespace palpa::anatomy
