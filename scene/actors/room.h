#pragma once

#include <vtkNew.h>

#include "anatomy/patient.h"

class vtkActor;
class vtkRenderer;

namespace palpa::scene {

/// Where a person stands who sees nothing else: a plain room, and in it a table of usual height
/// under what lies on it. It gives the eyes a horizon, a floor and a scale, and is darker than what
/// is worked on. All in A (up is -y); painted, without light. [chosen]
class Room {
 public:
  Room(vtkRenderer& renderer, const anatomy::Patient& patient);
  ~Room();
  void setVisible(bool visible);

  static constexpr double kReach = 5;  ///< m: all of it is nearer to whoever is in it

 private:
  vtkNew<vtkActor> actor_;
};

}  // namespace palpa::scene
