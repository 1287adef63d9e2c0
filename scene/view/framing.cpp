#include "scene/view/framing.h"

#include <algorithm>
#include <cmath>
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
  region.work_centre_A = region.focus_A;
  const auto near_edge = find(patient, anatomy::landmark::kNearEdge);
  region.on_table = entry && near_edge && near_edge->z() < entry->z();
  if (region.on_table) {
    region.work_centre_A = whole.center();
    region.work_radius = std::clamp(0.6 * whole.diagonal().norm(), 0.05, 0.30);
  }
  return region;
}

Rect partWithWork(const Pinhole& camera, const Vec3& centre_C, double radius, double aspect,
                  const Rect& before) {
  constexpr double kFilled = 0.8;             // of the smaller side
  constexpr double kLeastWidth = 0.5;         // of the picture's
  constexpr double kAway = 0.10, kAs = 0.15;  // of the part's width: as good as before
  const Rect whole{0, 0, camera.width, camera.height};
  if (centre_C.z() <= radius) return whole;
  const double u = camera.fx * centre_C.x() / centre_C.z() + camera.cx,
               v = camera.fy * centre_C.y() / centre_C.z() + camera.cy,
               across = 2 * camera.fx * radius / centre_C.z();
  const double most = std::min<double>(camera.width, aspect * camera.height);
  const double wanted = across / kFilled * std::max(aspect, 1.0);
  const double width = std::clamp(wanted, kLeastWidth * camera.width, most);
  const double height = width / aspect;
  const auto start = [](double middle, double length, int room) {
    return static_cast<int>(std::lround(std::clamp(middle - 0.5 * length, 0.0, room - length)));
  };
  const Rect part{start(u, width, camera.width), start(v, height, camera.height),
                  static_cast<int>(width), static_cast<int>(height)};
  if (!part.contains(u, v) || width < kFilled * across) return whole;
  const bool alike = std::abs(part.width - before.width) < kAs * width &&
                     std::abs(part.x - before.x) < kAway * width &&
                     std::abs(part.y - before.y) < kAway * width &&
                     before.right() <= camera.width && before.top() <= camera.height &&
                     std::abs(before.width - aspect * before.height) < 2 * aspect + 2;
  return alike ? before : part;
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
