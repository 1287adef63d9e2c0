#include "scene/view/framing.h"

#include <algorithm>
#include <optional>

#include "anatomy/parametric/phantoms.h"

namespace palpa::scene {
namespace {

using Box = Eigen::AlignedBox3d;

std::optional<Vec3> find(const anatomy::Patient& patient, const char* name) {
  const auto found = patient.landmarks.find(name);
  if (found == patient.landmarks.end()) return std::nullopt;
  return found->second;
}

Box boxOf(const anatomy::TriangleMesh& mesh) {
  Box box;
  for (const Vec3& p : mesh.points) box.extend(p);
  return box;
}

bool onSide(const Box& box, anatomy::Side side) {
  return (side == anatomy::Side::right) == (box.center().x() < 0);
}

Box clavicleBox(const anatomy::Patient& patient) {
  for (const anatomy::OrganSurface& organ : patient.organs) {
    if (organ.organ != Organ::clavicle) continue;
    const Box box = boxOf(organ.mesh);
    if (!box.isEmpty() && onSide(box, patient.side)) return box;
  }
  return {};
}

Box wholeBox(const anatomy::Patient& patient) {
  Box box;
  for (const anatomy::OrganSurface& organ : patient.organs) box.extend(boxOf(organ.mesh));
  for (const auto& [name, p_A] : patient.landmarks) box.extend(p_A);
  if (box.isEmpty()) box.extend(Box(Vec3::Constant(-0.1), Vec3::Constant(0.1)));
  return box;
}

bool hasOnlySkin(const anatomy::Patient& patient) {
  return !patient.organs.empty() &&
         std::all_of(patient.organs.begin(), patient.organs.end(),
                     [](const auto& organ) { return organ.organ == Organ::skin; });
}

}  // namespace

Region regionOf(const anatomy::Patient& patient) {
  const Box whole = wholeBox(patient);
  const auto entry = find(patient, anatomy::landmark::kEntry);
  const auto vein = find(patient, anatomy::landmark::kVeinTarget);
  Box near = clavicleBox(patient);
  if (near.isEmpty()) near = whole;
  Region region;
  region.focus_A = near.center();
  if (entry) region.focus_A = vein ? Vec3(0.5 * (*entry + *vein)) : *entry;
  region.centre_A = 0.5 * (near.center() + region.focus_A);
  region.width = std::clamp(1.3 * near.sizes().x(), 0.10, 0.40);
  region.whole_centre_A = whole.center();
  region.whole_radius = 0.5 * whole.diagonal().norm() + 0.05;
  region.whole_half = 0.5 * whole.sizes().maxCoeff();
  region.only_skin = hasOnlySkin(patient);
  if (region.only_skin) {
    region.centre_A = whole.center();
    region.width = std::clamp(1.15 * whole.sizes().x(), 0.05, 0.60);
    region.height = 1.25 * std::max(whole.sizes().y(), whole.sizes().z());
  }
  const auto near_edge = find(patient, anatomy::landmark::kNearEdge);
  region.on_table = entry && near_edge && near_edge->z() < entry->z();
  return region;
}

Aspect aspectOf(Plane plane, anatomy::Side side) {
  switch (plane) {
    case Plane::frontal:
      return {"FRONT", Vec3::UnitY(), Vec3::UnitZ(), "R", "L", "S", "I"};
    case Plane::axial:
      return {"TOP", -Vec3::UnitZ(), Vec3::UnitY(), "R", "L", "P", "A"};
    case Plane::sagittal:
      break;
  }
  if (side == anatomy::Side::right)
    return {"SIDE", Vec3::UnitX(), Vec3::UnitZ(), "P", "A", "S", "I"};
  return {"SIDE", -Vec3::UnitX(), Vec3::UnitZ(), "A", "P", "S", "I"};
}

Aspect aspectOnTable(Plane plane) {
  switch (plane) {
    case Plane::frontal:
      return {"FROM ABOVE", Vec3::UnitY(), Vec3::UnitZ(), "left", "right", "far", "near"};
    case Plane::axial:
      return {"FRONT", Vec3::UnitZ(), -Vec3::UnitY(), "left", "right", "", ""};
    case Plane::sagittal:
      break;
  }
  return {"SIDE", -Vec3::UnitX(), -Vec3::UnitY(), "near", "far", "", ""};
}

}  // namespace palpa::scene
