#include "scene/actors/cut_organs.h"

#include <vtkActor.h>
#include <vtkClipClosedSurface.h>
#include <vtkCutter.h>
#include <vtkNew.h>
#include <vtkPlane.h>
#include <vtkPlaneCollection.h>
#include <vtkPolyDataMapper.h>
#include <vtkPolyDataNormals.h>
#include <vtkProperty.h>
#include <vtkRenderer.h>

#include "scene/actors/organ_actors.h"
#include "scene/palette.h"

namespace palpa::scene {
namespace {

constexpr Rgb kFat{0.96, 0.88, 0.66};
constexpr double kPaler = 0.35;         // of white in a cut face
constexpr double kLayer = 2e-4;         // m, between the caps
constexpr double kOutline = 1e-4;       // m, of it before its cap
constexpr double kSharp_deg = 30;       // an edge, not a rounding
constexpr double kOutlineWidth_px = 3;  // of a picture twice as large as is kept
constexpr int kStep = 16;               // of red, from kind to kind

/// From the innermost out.
int layerOf(Organ organ) {
  if (organ == Organ::skin) return 4;
  if (organ == Organ::muscle) return 3;
  if (organ == Organ::lung) return 2;
  return isBone(organ) ? 1 : 0;
}

Rgb faceOf(Organ organ, const Rgb& colour) {
  if (organ == Organ::skin) return kFat;
  Rgb face = colour;
  for (double& part : face) part += kPaler * (1 - part);
  return face;
}

vtkSmartPointer<vtkPlane> planeAt(const Section& section, double behind) {
  const Vec3 p = section.p_A + behind * section.n_A;
  auto plane = vtkSmartPointer<vtkPlane>::New();
  plane->SetOrigin(p.data());
  plane->SetNormal(section.n_A.x(), section.n_A.y(), section.n_A.z());
  return plane;
}

vtkSmartPointer<vtkPolyData> cutSurface(vtkPolyData* surface, vtkPlane* plane, const Rgb& colour,
                                        const Rgb& face) {
  vtkNew<vtkPlaneCollection> planes;
  planes->AddItem(plane);
  vtkNew<vtkClipClosedSurface> cut;
  cut->SetInputData(surface);
  cut->SetClippingPlanes(planes);
  cut->SetScalarModeToColors();
  cut->SetBaseColor(colour[0], colour[1], colour[2]);
  cut->SetClipColor(face[0], face[1], face[2]);
  vtkNew<vtkPolyDataNormals> normals;
  normals->SetInputConnection(cut->GetOutputPort());
  normals->SetFeatureAngle(kSharp_deg);
  normals->Update();
  return normals->GetOutput();
}

vtkSmartPointer<vtkActor> outlineOf(vtkPolyData* surface, vtkPlane* plane) {
  vtkNew<vtkCutter> cutter;
  cutter->SetInputData(surface);
  cutter->SetCutFunction(plane);
  cutter->GenerateCutScalarsOff();
  cutter->Update();
  vtkNew<vtkPolyDataMapper> mapper;
  mapper->SetInputData(cutter->GetOutput());
  mapper->ScalarVisibilityOff();
  auto actor = vtkSmartPointer<vtkActor>::New();
  actor->SetMapper(mapper);
  const Rgb& ink = colour::kInk;
  actor->GetProperty()->SetColor(ink[0], ink[1], ink[2]);
  actor->GetProperty()->LightingOff();
  actor->GetProperty()->SetLineWidth(kOutlineWidth_px);
  return actor;
}

}  // namespace

CutOrgans::CutOrgans(vtkRenderer& renderer, const anatomy::Patient& patient,
                     const std::optional<Section>& section, SkinStyle skin) {
  for (const anatomy::OrganSurface& organ : patient.organs)
    if (!organ.mesh.triangles.empty() && !(coversOrgans(organ.organ) && skin == SkinStyle::hidden))
      add(renderer, organ, section, skin);
}

void CutOrgans::add(vtkRenderer& renderer, const anatomy::OrganSurface& organ,
                    const std::optional<Section>& section, SkinStyle skin) {
  constexpr double kThrough = 0.22;
  const Rgb colour = plainColourOf(organ);
  vtkSmartPointer<vtkPolyData> surface = polyDataOf(organ.mesh);
  CutPart part;
  part.organ = organ.organ;
  part.opacity = coversOrgans(organ.organ) && skin == SkinStyle::translucent ? kThrough : 1;
  part.by_cells = section.has_value();
  if (section) {
    const double deeper = kLayer * layerOf(organ.organ);
    const vtkSmartPointer<vtkActor> outline = outlineOf(surface, planeAt(*section, deeper));
    const Vec3 nearer = -kOutline * section->n_A;
    outline->SetPosition(nearer.x(), nearer.y(), nearer.z());
    renderer.AddActor(outline);
    parts_.push_back({organ.organ, outline, true, false, 1});
    surface = cutSurface(surface, planeAt(*section, deeper), colour, faceOf(organ.organ, colour));
  }
  vtkNew<vtkPolyDataMapper> mapper;
  mapper->SetInputData(surface);
  mapper->SetScalarModeToUseCellData();
  mapper->SetColorModeToDirectScalars();
  mapper->SetScalarVisibility(part.by_cells);
  part.actor = vtkSmartPointer<vtkActor>::New();
  part.actor->SetMapper(mapper);
  part.actor->GetProperty()->SetColor(colour[0], colour[1], colour[2]);
  renderer.AddActor(part.actor);
  parts_.push_back(part);
  paintKinds(false);
}

Organ CutOrgans::kindOf(std::uint8_t red) { return static_cast<Organ>(red / kStep); }

void CutOrgans::paintKinds(bool on) {
  for (CutPart& part : parts_) {
    vtkProperty* const look = part.actor->GetProperty();
    part.actor->SetVisibility(!on || (!part.is_outline && part.opacity == 1));
    if (part.is_outline) continue;
    part.actor->GetMapper()->SetScalarVisibility(part.by_cells && !on);
    look->SetLighting(!on);
    look->SetAmbient(on ? 1 : 0.34);
    look->SetDiffuse(on ? 0 : 0.70);
    look->SetSpecular(on ? 0 : 0.10);
    look->SetSpecularPower(24);
    look->SetOpacity(part.opacity);
    if (on) look->SetAmbientColor(kStep * static_cast<int>(part.organ) / 255.0, 0, 0);
    if (!on) look->SetAmbientColor(look->GetDiffuseColor());
  }
}

}  // namespace palpa::scene
