#pragma once

#include <vtkSmartPointer.h>

#include "anatomy/patient.h"

class vtkActor;

namespace palpa::scene {

/// Where the skin is cut by the plane through `p_A` with normal `n_A`, as a line: it shows the
/// depth in a fixed view without covering the organs. Null when the patient has no skin there.
vtkSmartPointer<vtkActor> skinSection(const anatomy::Patient& patient, const Vec3& p_A,
                                      const Vec3& n_A);

}  // namespace palpa::scene
