#pragma once

#include <vtkSmartPointer.h>

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

vtkSmartPointer<vtkPolyData> needleShape(
    const InstrumentSize& size);  ///< needle, hub, nozzle, scale
vtkSmartPointer<vtkPolyData> barrelShape(const InstrumentSize& size);   ///< the clear tube
vtkSmartPointer<vtkPolyData> plungerShape(const InstrumentSize& size);  ///< pushed home
vtkSmartPointer<vtkPolyData> bloodShape(
    const InstrumentSize& size);  ///< 1 m long, from z = 0 to -1
vtkSmartPointer<vtkPolyData> silhouetteShape(
    const InstrumentSize& size);  ///< plain, for small views

}  // namespace palpa::scene
