#pragma once

#include <vtkNew.h>

#include "anatomy/geometry/pose.h"
#include "scene/instrument_shape.h"
#include "scene/scene_state.h"

class vtkActor;
class vtkMatrix4x4;
class vtkRenderer;

namespace palpa::scene {

void copy(const Pose& X, vtkMatrix4x4& matrix);

/// What is held in the AR view: the needle with its syringe (clear graduated barrel, plunger,
/// blood), or the probe.
class Instrument {
 public:
  explicit Instrument(vtkRenderer& renderer);
  ~Instrument();

  /// `plunger` and `blood` are fractions of the stroke, held to 0..1; blood cannot be more than the
  /// plunger has drawn.
  void update(const Pose& X_AT, double plunger, double blood);
  void show(Tool tool);
  void hide();

 private:
  InstrumentSize size_;
  vtkNew<vtkActor> needle_, barrel_, plunger_, blood_, probe_;
  vtkNew<vtkMatrix4x4> X_AT_, X_A_plunger_, X_A_blood_;
  bool has_blood_ = false;
};

/// The same, reduced to what can be read in a small view.
class InstrumentSilhouette {
 public:
  explicit InstrumentSilhouette(vtkRenderer& renderer);
  ~InstrumentSilhouette();
  void update(const Pose& X_AT);
  void show(Tool tool);
  void hide();

 private:
  vtkNew<vtkActor> needle_, probe_;
  vtkNew<vtkMatrix4x4> X_AT_;
};

}  // namespace palpa::scene
