#include "apps/bench/pictures/plain_scene.h"

#include <vtkCamera.h>
#include <vtkRenderWindow.h>

#include "scene/palette.h"
#include "scene/panels.h"
#include "scene/renderer_setup.h"
#include "scene/view/ar_camera.h"

namespace palpa::bench {
namespace {

constexpr int kPeels = 100;       // as many as there are layers: the picture is right
constexpr double kAcross = 0.12;  // metres, of a fixed view
constexpr double kShaft_px = 5;

}  // namespace

PlainScene::View::View(const anatomy::Patient& patient)
    : organs(*renderer, patient), tool(*renderer) {
  scene::setUpRenderer(*renderer, scene::colour::kPanel);
  organs.setStyle(scene::SkinStyle::hidden);
}

PlainScene::PlainScene(scene::GlContextProvider& context, const anatomy::Patient& patient,
                       const Settings& settings)
    : window_(*context.window()),
      settings_(settings),
      panel_(scene::layoutPanels(settings.width, settings.height, scene::FixedViews::three).ar),
      picture_(*large_, true),
      organs_(*large_, patient),
      tool_(*large_),
      arrows_(*above_),
      hud_(*words_) {
  window_.SetSize(settings.width, settings.height);
  window_.SetNumberOfLayers(3);
  int layer = 0;
  for (vtkRenderer* renderer : {large_.Get(), above_.Get(), words_.Get()}) {
    scene::setUpRenderer(*renderer, scene::colour::kPanel);
    renderer->SetLayer(layer++);
    window_.AddRenderer(renderer);
  }
  above_->SetActiveCamera(large_->GetActiveCamera());
  if (settings.translucency == Translucency::peeling) {
    large_->UseDepthPeelingOn();
    large_->SetMaximumNumberOfPeels(kPeels);
    large_->SetOcclusionRatio(0);
  }
  if (!settings.fixed_views) return;
  const scene::Panels panels =
      scene::layoutPanels(settings.width, settings.height, scene::FixedViews::three);
  addFixedView(patient, -Vec3::UnitY(), Vec3::UnitZ(), panels.front);
  addFixedView(patient, Vec3::UnitX(), Vec3::UnitZ(), panels.side);
  addFixedView(patient, Vec3::UnitZ(), -Vec3::UnitY(), panels.top);
}

PlainScene::~PlainScene() {
  for (const auto& view : fixed_) window_.RemoveRenderer(view->renderer);
  for (vtkRenderer* renderer : {large_.Get(), above_.Get(), words_.Get()})
    window_.RemoveRenderer(renderer);
}

void PlainScene::addFixedView(const anatomy::Patient& patient, const Vec3& from_A, const Vec3& up_A,
                              const scene::Rect& where) {
  fixed_.push_back(std::make_unique<View>(patient));
  vtkRenderer& renderer = *fixed_.back()->renderer;
  const Vec3 focus_A = patient.landmark(anatomy::landmark::kEntry), eye_A = focus_A + from_A;
  vtkCamera* camera = renderer.GetActiveCamera();
  camera->ParallelProjectionOn();
  camera->SetPosition(eye_A.data());
  camera->SetFocalPoint(focus_A.data());
  camera->SetViewUp(up_A.data());
  camera->SetClippingRange(0.01, 2);
  camera->SetParallelScale(0.5 * kAcross * where.height / where.width);
  scene::setViewport(renderer, where, settings_.width, settings_.height);
  window_.AddRenderer(&renderer);
}

void PlainScene::show(const scene::SceneState& state) {
  const scene::Rect where = scene::letterbox(panel_, state.camera.width, state.camera.height);
  const scene::Pinhole pinhole = scene::scaled(state.camera, where.width, where.height);
  for (vtkRenderer* renderer : {large_.Get(), above_.Get()})
    scene::setViewport(*renderer, where, settings_.width, settings_.height);
  scene::aim(*large_->GetActiveCamera(), pinhole, state.X_CA, {0.1, 1.5});
  picture_.show(*state.picture);
  tool_.update(state.X_AT, state.plunger, state.blood, state.blood_of);
  tool_.show(state.tool);
  arrows_.update(state.forces, state.X_CA, pinhole.fx, kShaft_px * settings_.height / 720.0);
  hud_.update(state.hud, state.forces, panel_, scene::textSize_px(settings_.height));
  for (const auto& view : fixed_) {
    view->tool.update(state.X_AT);
    view->tool.show(state.tool);
  }
  window_.Render();
}

}  // namespace palpa::bench
