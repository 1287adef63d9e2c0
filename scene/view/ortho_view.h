#pragma once

#include <vtkNew.h>
#include <vtkSmartPointer.h>

#include <memory>
#include <vector>

#include "scene/actors/camera_picture.h"
#include "scene/actors/instrument.h"
#include "scene/actors/lines.h"
#include "scene/actors/organ_actors.h"
#include "scene/actors/search_overlay.h"
#include "scene/overlay/label.h"
#include "scene/panels.h"
#include "scene/view/framing.h"

class vtkRenderer;
class vtkRenderWindow;

namespace palpa::scene {

/// A fixed parallel view. The anatomy in it never moves, so it is drawn once, kept as a picture and
/// put behind the tool; the tool therefore shows through the organs, as on a radiograph. Without
/// what is `inside` only the skin is there, solid, and hides what is under it, the tool as well.
class OrthoView {
 public:
  OrthoView(vtkRenderWindow& window, const anatomy::Patient& patient, const Region& region,
            Plane plane, bool inside = true);
  ~OrthoView();

  void setDrawn(bool drawn);

  void addTrail(Trail& trail);
  void place(const Rect& where, int window_width, int window_height, int text_px);

  /// Painting the still picture: prepare all views, render the window once, keep from what it
  /// shows.
  void prepareStill();
  void keepStill(const Image& window_picture);

  void update(const SceneState& state);

 private:
  void aimCamera();
  vtkSmartPointer<vtkActor> sectionOf(const anatomy::Patient& patient) const;
  Sight sight() const;
  double metresAcross() const;  ///< at the panel's width
  void layoutWords(int text_px);
  void putScaleBar(const TextStyle& style);
  bool claim(const Rect& plate);
  void put(const std::string& words, const TextStyle& style, int x, int y);

  vtkNew<vtkRenderer> renderer_;
  vtkRenderWindow& window_;
  Plane plane_;
  Region region_;
  Aspect aspect_;
  bool inside_;
  Rect where_;
  int window_height_ = 1;
  OrganActors organs_;
  vtkSmartPointer<vtkActor> section_;
  Backdrop backdrop_;
  SearchOverlay search_;
  InstrumentSilhouette tool_, other_probe_;
  Plates plates_;
  vtkSmartPointer<vtkActor> trail_;
  std::vector<std::unique_ptr<Label>> words_;
  std::vector<Rect> claimed_;  ///< their plates
};

}  // namespace palpa::scene
