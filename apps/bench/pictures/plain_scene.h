#pragma once

#include <vtkNew.h>
#include <vtkRenderer.h>

#include <memory>
#include <vector>

#include "anatomy/patient.h"
#include "scene/actors/camera_picture.h"
#include "scene/actors/force_arrows.h"
#include "scene/actors/instrument.h"
#include "scene/actors/organ_actors.h"
#include "scene/overlay/hud.h"
#include "scene/scene_state.h"
#include "scene/window/gl_context.h"

namespace palpa::bench {

/// What a program would draw that leaves everything to VTK: the same meshes, picture, tool, arrows,
/// words and fixed views, one renderer each, drawn anew in each frame; VTK's textured background,
/// its lights, its translucency. No shadow, no smoothing, no pass of ours.
class PlainScene {
 public:
  enum class Translucency { peeling, blending };
  struct Settings {
    int width = 1280, height = 720;
    Translucency translucency = Translucency::peeling;
    bool fixed_views = true;
  };
  PlainScene(scene::GlContextProvider& context, const anatomy::Patient& patient,
             const Settings& settings);
  ~PlainScene();

  void show(const scene::SceneState& state);

 private:
  struct View {
    explicit View(const anatomy::Patient& patient);
    vtkNew<vtkRenderer> renderer;
    scene::OrganActors organs;
    scene::InstrumentSilhouette tool;
  };
  void addFixedView(const anatomy::Patient& patient, const Vec3& from_A, const Vec3& up_A,
                    const scene::Rect& where);

  vtkRenderWindow& window_;
  Settings settings_;
  scene::Rect panel_;
  vtkNew<vtkRenderer> large_, above_, words_;
  scene::Backdrop picture_;
  scene::OrganActors organs_;
  scene::Instrument tool_;
  scene::ForceArrows arrows_;
  scene::HudPainter hud_;
  std::vector<std::unique_ptr<View>> fixed_;
};

}  // namespace palpa::bench
