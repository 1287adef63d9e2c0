#pragma once

#include <vtkSmartPointer.h>

class vtkMapper;
class vtkPolyDataMapper;

namespace palpa::scene {

/// A mapper of surfaces that can be told what its drawing leaves behind: colours, depths, or both.
vtkSmartPointer<vtkPolyDataMapper> makePassMapper();
/// Of such a mapper.
void setWrites(vtkMapper& mapper, bool colours, bool depths);

}  // namespace palpa::scene
