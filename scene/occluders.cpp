#include "scene/occluders.h"

#include <vtkActor.h>
#include <vtkMatrix4x4.h>
#include <vtkNew.h>
#include <vtkPolyData.h>
#include <vtkPolyDataMapper.h>
#include <vtkProp.h>
#include <vtkPropCollection.h>
#include <vtkRenderer.h>
#include <vtkSmartPointer.h>

#include "scene/instrument.h"
#include "scene/organ_actors.h"
#include "scene/pass_mapper.h"

namespace palpa::scene {
struct Occluders::Thing {
  const anatomy::TriangleMesh* mesh = nullptr;
  vtkNew<vtkActor> actor;
  vtkSmartPointer<vtkPolyDataMapper> mapper = makePassMapper();
  vtkNew<vtkMatrix4x4> X_A;
};

Occluders::Occluders(vtkRenderer& renderer) : renderer_(renderer) {}
Occluders::~Occluders() = default;

void Occluders::update(const std::vector<Occluder>& things, bool picture) {
  while (things_.size() < things.size()) {
    things_.push_back(std::make_unique<Thing>());
    Thing& thing = *things_.back();
    setWrites(*thing.mapper, false, true);
    thing.actor->SetMapper(thing.mapper);
    thing.actor->SetUserMatrix(thing.X_A);
    // In front of all others, which VTK draws in the order in which they came.
    vtkNew<vtkPropCollection> others;
    vtkPropCollection* now = renderer_.GetViewProps();
    now->InitTraversal();
    while (vtkProp* prop = now->GetNextProp()) others->AddItem(prop);
    renderer_.RemoveAllViewProps();
    renderer_.AddActor(thing.actor);
    others->InitTraversal();
    while (vtkProp* prop = others->GetNextProp()) renderer_.AddViewProp(prop);
  }
  for (std::size_t i = 0; i < things_.size(); ++i) {
    Thing& thing = *things_[i];
    const bool there = picture && i < things.size() && things[i].mesh;
    thing.actor->SetVisibility(there);
    if (!there) continue;
    if (thing.mesh != things[i].mesh) {
      thing.mesh = things[i].mesh;
      thing.mapper->SetInputData(polyDataOf(*thing.mesh));
    }
    copy(things[i].X_A, *thing.X_A);
  }
}

}  // namespace palpa::scene
