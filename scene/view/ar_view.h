#pragma once

#include <vtkNew.h>

#include <memory>

#include "scene/actors/camera_picture.h"
#include "scene/actors/force_arrows.h"
#include "scene/actors/instrument.h"
#include "scene/actors/lines.h"
#include "scene/actors/needle_line.h"
#include "scene/actors/organ_actors.h"
#include "scene/actors/room.h"
#include "scene/actors/search_overlay.h"
#include "scene/actors/table.h"
#include "scene/actors/tool_shadow.h"
#include "scene/overlay/clearance.h"
#include "scene/panels.h"
#include "scene/view/ar_camera.h"
#include "scene/view/compositor.h"
#include "scene/view/framing.h"
#include "scene/view/navigation.h"
#include "scene/view/scene_view.h"
#include "scene/view/two_eyes.h"

class vtkRenderer;
class vtkRenderWindow;

namespace palpa::scene {

/// The camera picture with the registered patient on it. Which camera looks:
///
///     registered                the real one: X_CA and its intrinsics, exactly
///     picture, not registered   none: the picture alone, since a patient drawn anywhere would
///     mislead neither                   a virtual one near the entry point, which a person may
///     walk around
class ArView {
 public:
  ArView(vtkRenderWindow& window, const anatomy::Patient& patient, const Region& region,
         const ViewLayout& layout);
  ~ArView();

  void addTrail(Trail& trail);
  void place(const Rect& panel, int window_width, int window_height);
  void update(const SceneState& state);
  /// Of the two eyes of one merged picture the one that is drawn next, 0 or 1.
  void showEye(std::size_t eye);

  bool isVirtual() const { return virtual_; }
  bool showsPatient() const { return shows_patient_; }
  OrbitCamera& orbit() { return orbit_; }
  const Rect& picture() const { return picture_; }  ///< the part of the panel that is drawn on
  /// Of a stereo view; as large as their panels
  const std::array<EyeCamera, 2>& eyes() const { return eyes_; }
  const std::array<Rect, 2>& panelsOfEyes() const { return eye_panels_; }
  /// What is seen where: the camera, or one of two eyes (0 left, 1 right), and the part of the
  /// window that it fills.
  EyeCamera eye(std::size_t of = 0) const {
    return stereo_ == Stereo::none ? EyeCamera{pinhole_, X_CA_} : eyes_.at(of);
  }
  /// Where an eye (0, 1; without stereo 0) has the tool in the window, its tip and where a needle
  /// went in.
  Surroundings toolOnScreen(const SceneState& state, std::size_t eye) const;
  const Rect& eyePanel(std::size_t of = 0) const {
    return stereo_ == Stereo::none ? picture_ : eye_panels_.at(of);
  }

 private:
  void chooseCamera(const SceneState& state);
  void choosePart(const SceneState& state);
  void applyCameras(const SceneState& state);
  void lookThrough(const EyeCamera& eye, const Rect& where, vtkRenderer& behind);
  void setUpRenderers();
  void showLines(const SceneState& state, bool visible);
  double lineUnit_px() const;  ///< a 720th of the window's height, at least a pixel
  void showNeedleLine(const SceneState& state, bool visible);
  void showPatient(const SceneState& state, bool visible);

  vtkRenderWindow& window_;
  vtkNew<vtkRenderer> renderer_;  // picture, organs, needle, trail
  vtkNew<vtkRenderer> on_skin_;   // after the translucent skin: what a search has felt
  vtkNew<vtkRenderer> above_;     // force arrows, guide, the tip's ellipse, pins: never hidden
  Region region_;
  Rect panel_, picture_;
  int window_width_ = 1, window_height_ = 1;
  Stereo stereo_;
  bool see_through_, shows_inside_, framed_;
  Rect part_;       ///< of the camera's picture, from its top left
  Pinhole camera_;  ///< of that part
  Image part_picture_;
  const Image* shown_picture_ = nullptr;
  std::array<EyeCamera, 2> eyes_;
  std::array<Rect, 2> eye_panels_;
  Vec3 tip_A_ = Vec3::Zero();
  bool virtual_ = true, in_room_ = false;
  bool real_things_ = false;
  bool shows_patient_ = true;
  OrbitCamera orbit_;
  Pinhole pinhole_;
  Pose X_CA_ = Pose::Identity();
  Table table_;
  std::unique_ptr<Room> room_;  ///< null but before eyes that see nothing else
  Glass glass_;
  OrganActors organs_;
  std::unique_ptr<DeflectedSkin> skin_;  // null: it does not give way
  Instrument instrument_, other_probe_;
  vtkSmartPointer<vtkActor> trail_;
  ForceArrows arrows_;
  EdgedLines guide_, ellipse_;
  ToolShadows shadows_;
  NeedleLine needle_line_;
  SearchOverlay search_;
  Compositor compositor_;
  Occluders occluders_;
  std::unique_ptr<SecondEye> second_;  // null: one camera, or eyes one after the other
};

}  // namespace palpa::scene
