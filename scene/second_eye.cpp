#include "scene/second_eye.h"

#include <vtkProp.h>
#include <vtkPropCollection.h>
#include <vtkRenderWindow.h>
#include <vtkRenderer.h>
#include <vtkTexture.h>

#include "scene/palette.h"
#include "scene/renderer_setup.h"

namespace palpa::scene {
namespace {

bool same(vtkPropCollection& a, vtkPropCollection& b) {
  if (a.GetNumberOfItems() != b.GetNumberOfItems()) return false;
  for (int i = 0; i < a.GetNumberOfItems(); ++i)
    if (a.GetItemAsObject(i) != b.GetItemAsObject(i)) return false;
  return true;
}

void copyProps(vtkRenderer& from, vtkRenderer& to) {
  if (same(*from.GetViewProps(), *to.GetViewProps())) return;
  to.RemoveAllViewProps();
  for (int i = 0; i < from.GetViewProps()->GetNumberOfItems(); ++i)
    to.AddViewProp(static_cast<vtkProp*>(from.GetViewProps()->GetItemAsObject(i)));
}

}  // namespace

SecondEye::SecondEye(vtkRenderWindow& window, vtkRenderer& behind, vtkRenderer& glass,
                     vtkRenderer& on_skin, vtkRenderer& above)
    : window_(window),
      first_behind_(behind),
      first_glass_(glass),
      first_on_skin_(on_skin),
      first_above_(above) {
  forAll([&](vtkRenderer& renderer) {
    setUpRenderer(renderer, colour::kBehindBottom);
    renderer.SetActiveCamera(behind_->GetActiveCamera());
    window_.AddRenderer(&renderer);
  });
  behind_->SetBackground(first_behind_.GetBackground());
  behind_->SetBackgroundAlpha(first_behind_.GetBackgroundAlpha());
  behind_->SetBackground2(first_behind_.GetBackground2());
  glass_->EraseOff();
  on_skin_->EraseOff();
  above_->SetLayer(first_above_.GetLayer());
}

SecondEye::~SecondEye() {
  forAll([&](vtkRenderer& renderer) { window_.RemoveRenderer(&renderer); });
}

void SecondEye::mirror() {
  copyProps(first_behind_, *behind_);
  copyProps(first_glass_, *glass_);
  copyProps(first_on_skin_, *on_skin_);
  copyProps(first_above_, *above_);
  behind_->SetBackgroundTexture(first_behind_.GetBackgroundTexture());
  behind_->SetTexturedBackground(first_behind_.GetTexturedBackground());
  behind_->SetGradientBackground(first_behind_.GetGradientBackground());
  on_skin_->SetDraw(first_on_skin_.GetDraw());
  above_->SetDraw(first_above_.GetDraw());
}

}  // namespace palpa::scene
