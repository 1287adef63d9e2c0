#pragma once

#include <vtkSmartPointer.h>

#include <array>
#include <initializer_list>
#include <memory>

#include "anatomy/geometry/pose.h"
#include "scene/palette.h"

class vtkPolyData;

namespace palpa::scene {

/// Point of a turned shape: distance from the axis, and place along +z. Metres.
struct ProfilePoint {
  double r = 0, z = 0;
};

/// Collects coloured surfaces and lines into one mesh, so that an instrument is one draw call.
class MeshBuilder {
 public:
  MeshBuilder();
  ~MeshBuilder();

  /// Turns the profile about the z axis. Profiles that run toward -z have their outside away from
  /// the axis.
  void turn(std::initializer_list<ProfilePoint> profile, const Rgb& colour, int sides = 24);
  /// A half-sphere about the z axis, its foremost point at (0, 0, z), opening toward -z; smooth.
  void dome(double radius, double z, const Rgb& colour, int sides = 24);
  /// A sphere; smooth.
  void ball(double radius, const Rgb& colour, int sides = 24, const Vec3& centre = Vec3::Zero());
  /// An arc about the z axis, in front (centred on angle `middle`).
  void arc(double r, double z, double middle, double half_angle, const Rgb& colour);
  void triangle(const Vec3& a, const Vec3& b, const Vec3& c, const Rgb& colour);

  vtkSmartPointer<vtkPolyData> mesh() const;

 private:
  long addPoint(const Vec3& p, const Vec3& n, const Rgb& colour);
  void cap(double radius, const Vec3& centre, double to_pole_angle, const Rgb& colour, int sides,
           int rings);
  void band(const ProfilePoint& a, const ProfilePoint& b, const Rgb& colour, int sides);

  struct Data;
  std::unique_ptr<Data> data_;
};

}  // namespace palpa::scene
