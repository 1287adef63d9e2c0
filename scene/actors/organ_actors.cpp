#include "scene/actors/organ_actors.h"

#include <vtkActor.h>
#include <vtkCellArray.h>
#include <vtkCutter.h>
#include <vtkFloatArray.h>
#include <vtkImageData.h>
#include <vtkNew.h>
#include <vtkPlane.h>
#include <vtkPointData.h>
#include <vtkPoints.h>
#include <vtkPolyData.h>
#include <vtkPolyDataMapper.h>
#include <vtkProperty.h>
#include <vtkRenderer.h>
#include <vtkTexture.h>

#include <algorithm>
#include <cstring>

#include "scene/actors/instrument.h"
#include "scene/actors/skin_light.h"
#include "scene/palette.h"
#include "scene/renderer_setup.h"

namespace palpa::scene {
namespace {

constexpr double kSilicone = 0.5;  // opacity of a block, whose shape is to be seen, too
constexpr double kSeenAs =
    0.72;  // of a part of a body in its place: the block hardly shines through

double translucentOpacity(Organ organ) {
  if (organ == Organ::skin) return 0.28;
  return organ == Organ::muscle ? 0.24 : 1;
}

bool hasPicture(const anatomy::OrganSurface& organ) {
  const anatomy::RgbPicture& texture = organ.texture;
  return texture.width > 0 && texture.height > 0 &&
         organ.mesh.uvs.size() == organ.mesh.points.size() &&
         texture.rgb.size() == std::size_t{3} * texture.width * texture.height;
}

// White under a picture means the picture's own colours.
Rgb colourOf(const anatomy::OrganSurface& organ) {
  return hasPicture(organ) ? Rgb{organ.rgba[0], organ.rgba[1], organ.rgba[2]}
                           : plainColourOf(organ);
}

// Both count rows in the direction of v, so that the first row lies at v = 0.
vtkSmartPointer<vtkTexture> textureOf(const anatomy::RgbPicture& picture) {
  vtkNew<vtkImageData> image;
  image->SetDimensions(picture.width, picture.height, 1);
  image->AllocateScalars(VTK_UNSIGNED_CHAR, 3);
  std::memcpy(image->GetScalarPointer(), picture.rgb.data(), picture.rgb.size());
  auto texture = vtkSmartPointer<vtkTexture>::New();
  texture->SetInputData(image);
  texture->InterpolateOn();
  texture->MipmapOff();
  texture->RepeatOff();
  texture->EdgeClampOn();
  return texture;
}

vtkSmartPointer<vtkActor> actorOf(const anatomy::OrganSurface& organ, vtkPolyData* surface) {
  const vtkSmartPointer<vtkPolyDataMapper> mapper = makePassMapper();
  mapper->SetInputData(surface);
  auto actor = vtkSmartPointer<vtkActor>::New();
  actor->SetMapper(mapper);
  if (hasPicture(organ)) actor->SetTexture(textureOf(organ.texture));
  Rgb colour = colourOf(organ);
  vtkProperty* look = actor->GetProperty();
  look->SetColor(colour.data());
  look->SetAmbient(0.28);
  look->SetDiffuse(0.76);
  look->SetSpecular(0.18);
  look->SetSpecularPower(24);
  return actor;
}

/// The far walls alone, as they look from inside.
vtkSmartPointer<vtkActor> innerSideOf(const anatomy::OrganSurface& organ, vtkPolyData* surface) {
  vtkSmartPointer<vtkActor> actor = actorOf(organ, surface);
  actor->GetProperty()->FrontfaceCullingOn();
  actor->GetProperty()->SetAmbient(0.52);  // light comes in from everywhere
  actor->GetProperty()->SetDiffuse(0.40);
  actor->GetProperty()->SetSpecular(0);
  return actor;
}

}  // namespace

const anatomy::OrganSurface* seenSkin(const anatomy::Patient& patient) {
  if (patient.seen_as) return &*patient.seen_as;
  for (const anatomy::OrganSurface& organ : patient.organs)
    if (organ.organ == Organ::skin && !organ.mesh.triangles.empty()) return &organ;
  return nullptr;
}

Rgb plainColourOf(const anatomy::OrganSurface& organ) {
  const auto& [r, g, b, a] = organ.rgba;
  return r == 1 && g == 1 && b == 1 ? organColour(organ.organ) : Rgb{r, g, b};
}

bool coversOrgans(Organ organ) { return organ == Organ::skin || organ == Organ::muscle; }

vtkSmartPointer<vtkPolyData> polyDataOf(const anatomy::TriangleMesh& mesh) {
  vtkNew<vtkPoints> points;
  points->Allocate(static_cast<vtkIdType>(mesh.points.size()));
  for (const Vec3& p : mesh.points) points->InsertNextPoint(p.data());
  vtkNew<vtkCellArray> triangles;
  for (const auto& t : mesh.triangles) {
    const vtkIdType corners[] = {t[0], t[1], t[2]};
    triangles->InsertNextCell(3, corners);
  }
  auto result = vtkSmartPointer<vtkPolyData>::New();
  result->SetPoints(points);
  result->SetPolys(triangles);
  if (mesh.normals.size() == mesh.points.size()) {
    vtkNew<vtkFloatArray> normals;
    normals->SetNumberOfComponents(3);
    for (const Vec3& n : mesh.normals) normals->InsertNextTuple3(n.x(), n.y(), n.z());
    result->GetPointData()->SetNormals(normals);
  }
  if (!mesh.uvs.empty() && mesh.uvs.size() == mesh.points.size()) {
    vtkNew<vtkFloatArray> coordinates;
    coordinates->SetNumberOfComponents(2);
    coordinates->SetName("TextureCoordinates");
    for (const auto& [u, v] : mesh.uvs) coordinates->InsertNextTuple2(u, v);
    result->GetPointData()->SetTCoords(coordinates);
  }
  return result;
}

OrganActors::OrganActors(vtkRenderer& renderer, const anatomy::Patient& patient, Glass* glass)
    : renderer_(renderer), glass_(glass) {
  seen_as_ = glass_ && patient.seen_as;
  for (const anatomy::OrganSurface& organ : patient.organs)
    if (!seen_as_ || organ.organ != Organ::skin) add(organ);
  if (seen_as_) add(*patient.seen_as);
  if (glass_ && !seen_as_ && patient.organs.size() == 1 && skin_) {
    inner_side_ = innerSideOf(patient.organs.front(), skin_);
    renderer.AddActor(inner_side_);
  }
  apply();
}

OrganActors::~OrganActors() = default;

void OrganActors::add(const anatomy::OrganSurface& organ) {
  const vtkSmartPointer<vtkPolyData> surface = polyDataOf(organ.mesh);
  if (!skin_ && organ.organ == Organ::skin) skin_ = surface;
  OrganPart part{actorOf(organ, surface), surface, organ.organ, false};
  if (part.organ == Organ::skin) lightAsSkin(*part.actor);
  // The far side of a translucent surface would blend a second time.
  if (coversOrgans(part.organ)) part.actor->GetProperty()->BackfaceCullingOn();
  renderer_.AddActor(part.actor);
  parts_.push_back(std::move(part));
}

void OrganActors::setStyle(SkinStyle style) {
  if (style == style_) return;
  style_ = style;
  apply();
}

void OrganActors::setVisible(bool visible) {
  if (visible == visible_) return;
  visible_ = visible;
  apply();
}

void OrganActors::setInside(bool shown) {
  if (shown == inside_) return;
  inside_ = shown;
  apply();
}

void OrganActors::setWalls(bool shown) {
  if (shown == walls_) return;
  walls_ = shown;
  apply();
}

void OrganActors::setPose(const Pose& X_AB) {
  if (!moved_ && X_AB.matrix().isIdentity(0)) return;
  copy(X_AB, *X_AB_);
  if (!moved_)
    for (OrganPart& part : parts_) part.actor->SetUserMatrix(X_AB_);
  moved_ = true;
}

void OrganActors::moveTo(bool glass, OrganPart& part) {
  if (!glass_ || glass == part.in_glass) return;
  part.in_glass = glass;
  if (glass) {
    renderer_.RemoveActor(part.actor);
    glass_->add(part.actor, part.surface);
  } else {
    glass_->remove(part.actor);
    renderer_.AddActor(part.actor);
  }
}

void OrganActors::apply() {
  for (OrganPart& part : parts_) {
    const bool hidden = (coversOrgans(part.organ) && style_ == SkinStyle::hidden) ||
                        (part.organ != Organ::skin && !inside_);
    part.actor->SetVisibility(visible_ && !hidden);
    double opacity = style_ == SkinStyle::translucent ? translucentOpacity(part.organ) : 1;
    if (inner_side_ && walls_) opacity = std::max(opacity, kSilicone);
    if (seen_as_ && part.organ == Organ::skin) opacity = std::max(opacity, kSeenAs);
    part.actor->GetProperty()->SetOpacity(opacity);
    moveTo(opacity < 1, part);
  }
  if (inner_side_)
    inner_side_->SetVisibility(visible_ && walls_ && style_ == SkinStyle::translucent);
}

vtkSmartPointer<vtkActor> skinSection(const anatomy::Patient& patient, const Vec3& p_A,
                                      const Vec3& n_A) {
  for (const anatomy::OrganSurface& organ : patient.organs) {
    if (organ.organ != Organ::skin) continue;
    vtkNew<vtkPlane> plane;
    plane->SetOrigin(p_A.x(), p_A.y(), p_A.z());
    plane->SetNormal(n_A.x(), n_A.y(), n_A.z());
    vtkNew<vtkCutter> cutter;
    cutter->SetInputData(polyDataOf(organ.mesh));
    cutter->SetCutFunction(plane);
    cutter->Update();
    if (cutter->GetOutput()->GetNumberOfCells() == 0) return nullptr;
    vtkNew<vtkPolyDataMapper> mapper;
    mapper->SetInputData(cutter->GetOutput());
    mapper->ScalarVisibilityOff();
    auto actor = vtkSmartPointer<vtkActor>::New();
    actor->SetMapper(mapper);
    Rgb colour = colour::kSection;
    actor->GetProperty()->SetColor(colour.data());
    actor->GetProperty()->SetLineWidth(2);
    actor->GetProperty()->LightingOff();
    return actor;
  }
  return nullptr;
}

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
