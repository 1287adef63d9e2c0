#include "scene/skin_section.h"

#include <vtkActor.h>
#include <vtkCutter.h>
#include <vtkNew.h>
#include <vtkPlane.h>
#include <vtkPolyData.h>
#include <vtkPolyDataMapper.h>
#include <vtkProperty.h>

#include "scene/organ_actors.h"
#include "scene/palette.h"

namespace palpa::scene {

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

}  // namespace palpa::scene
