#pragma once

#include <array>

#include <vtkNew.h>
#include <vtkSmartPointer.h>

#include "anatomy/geometry/pose.h"
#include "scene/scene_state.h"

class vtkPolyData;

/// Shapes of the 18G puncture needle on its 12 ml syringe, in the tool frame T: tip at the origin,
/// +z the way the needle advances, so the instrument lies at z <= 0. The bevel's opening faces +y.
/// Sizes: 18G outer diameter 1.27 mm (ISO 9626), pink hub (ISO 6009), 15.9 mm bore (12 ml in 60
/// mm).
namespace palpa::scene {

struct InstrumentSize {
  double needle_radius = 0.000635;
  double needle_length = 0.070;
  double bevel_length = 0.0036;
  double bore_radius = 0.00795;
  double barrel_radius = 0.0088;
  double barrel_front = -0.089;  ///< z of the inner end of the bore
  double stroke = 0.0605;        ///< 12 ml / (pi bore^2)
  double barrel_length = 0.072;
};

/// A finger's stand-in for palpation, in T as well: the foremost point of its half-sphere at the
/// origin, the sphere's centre at z = -tip_radius. The tip is as wide as a fingertip (16 mm), round
/// and without an edge that a hand could feel.
struct ProbeSize {
  double tip_radius = 0.008;
  double shaft_radius = 0.0045;
  double shaft_end = -0.110;  ///< z where the handle begins
  double handle_radius = 0.0075;
  double handle_end = -0.190;
};

vtkSmartPointer<vtkPolyData> probeShape(const ProbeSize& size);
vtkSmartPointer<vtkPolyData> needleShape(
    const InstrumentSize& size);  ///< needle, hub, nozzle, scale
vtkSmartPointer<vtkPolyData> barrelShape(const InstrumentSize& size);   ///< the clear tube
vtkSmartPointer<vtkPolyData> plungerShape(const InstrumentSize& size);  ///< pushed home
/// 1 m long, from z = 0 to -1; white, for the actor's colour to say whose it is
vtkSmartPointer<vtkPolyData> bloodShape(const InstrumentSize& size);
vtkSmartPointer<vtkPolyData> bubblesShape(
    const InstrumentSize& size);  ///< in the front of the bore, at its top
vtkSmartPointer<vtkPolyData> silhouetteShape(
    const InstrumentSize& size);  ///< plain, for small views

}  // namespace palpa::scene

class vtkActor;
class vtkMatrix4x4;
class vtkRenderer;

namespace palpa::scene {

class Glass;

void copy(const Pose& X, vtkMatrix4x4& matrix);

/// What is held in the AR view: the needle with its syringe (clear graduated barrel, plunger,
/// blood), or the probe.
class Instrument {
 public:
  /// `glass`: where its clear barrel is drawn, before all that is translucent; null: in `renderer`,
  /// by VTK's translucent pass.
  explicit Instrument(vtkRenderer& renderer, Glass* glass = nullptr);
  ~Instrument();

  /// `plunger` and `blood` are fractions of the stroke, held to 0..1; blood cannot be more than the
  /// plunger has drawn. `of`: whose (SceneState::blood_of).
  void update(const Pose& X_AT, double plunger, double blood, Tissue of);
  void show(Tool tool);
  void hide();

 private:
  std::array<vtkActor*, 6> actors() const;

  InstrumentSize size_;
  vtkNew<vtkActor> needle_, barrel_, plunger_, blood_, bubbles_, probe_;
  vtkNew<vtkMatrix4x4> X_AT_, X_A_plunger_, X_A_blood_;
  bool has_blood_ = false, has_bubbles_ = false;
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
