#pragma once

#include <vtkNew.h>

#include "anatomy/geometry/pose.h"
#include "scene/instrument_shape.h"

class vtkActor;
class vtkMatrix4x4;
class vtkRenderer;

namespace palpa::scene {

void copy(const Pose& X, vtkMatrix4x4& matrix);

/// The needle with its syringe in the AR view: clear graduated barrel, plunger, blood.
class Instrument {
 public:
  explicit Instrument(vtkRenderer& renderer);
  ~Instrument();

  /// `plunger` and `blood` are fractions of the stroke, held to 0..1; blood cannot be more than the
  /// plunger has drawn.
  void update(const Pose& X_AT, double plunger, double blood);
  void setVisible(bool visible);

 private:
  InstrumentSize size_;
  vtkNew<vtkActor> needle_, barrel_, plunger_, blood_;
  vtkNew<vtkMatrix4x4> X_AT_, X_A_plunger_, X_A_blood_;
  bool has_blood_ = false;
};

/// The same, reduced to what can be read in a small view.
class InstrumentSilhouette {
 public:
  explicit InstrumentSilhouette(vtkRenderer& renderer);
  ~InstrumentSilhouette();
  void update(const Pose& X_AT);
  void setVisible(bool visible);

 private:
  vtkNew<vtkActor> actor_;
  vtkNew<vtkMatrix4x4> X_AT_;
};

}  // namespace palpa::scene
