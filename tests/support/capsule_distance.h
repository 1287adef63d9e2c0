#pragma once

#include <algorithm>
#include <cmath>
#include <vector>

#include "anatomy/query/bone_capsules.h"

/// What capsules say of a surface, worked out beside the program's own.
namespace palpa::measure {

/// Of p from the capsule's surface, negative inside; `n`, if asked for: away from it.
inline double distanceTo(const Capsule& capsule, const Vec3& p, Vec3* n = nullptr) {
  const Vec3 a = unpack(capsule.a), core = unpack(capsule.b) - a;
  const double length2 = core.squaredNorm();
  const double t = length2 > 0 ? std::clamp((p - a).dot(core) / length2, 0.0, 1.0) : 0;
  const Vec3 off = p - a - t * core;
  if (n) *n = off.normalized();
  return off.norm() - capsule.radius;
}

inline double distanceTo(const std::vector<Capsule>& chain, const Vec3& p, Vec3* n = nullptr) {
  double least = 1;
  for (const Capsule& capsule : chain) {
    Vec3 away = Vec3::Zero();
    const double d = distanceTo(capsule, p, &away);
    if (d >= least) continue;
    least = d;
    if (n) *n = away;
  }
  return least;
}

/// How far, rms, a surface's points within `reach` of `near` lie off the capsules.
inline double misfit(const anatomy::TriangleMesh& mesh, const std::vector<Capsule>& chain,
                     const Vec3& near = Vec3::Zero(), double reach = 10) {
  double squares = 0;
  int count = 0;
  for (const Vec3& p : mesh.points) {
    if ((p - near).norm() > reach) continue;
    squares += std::pow(distanceTo(chain, p), 2);
    ++count;
  }
  return count ? std::sqrt(squares / count) : 1;
}

inline std::vector<Capsule> capsulesOf(const std::vector<anatomy::Rod>& rods) {
  std::vector<Capsule> capsules;
  for (const anatomy::Rod& rod : rods)
    capsules.push_back({pack(rod.a), pack(rod.b), rod.radius, Organ::none, 0, {}});
  return capsules;
}

inline Capsule lengthened(Capsule capsule, double by) {
  const Vec3 a = unpack(capsule.a), b = unpack(capsule.b);
  const Vec3 along = (b - a).norm() > 0 ? Vec3((b - a).normalized()) : Vec3(Vec3::Zero());
  capsule.a = pack(Vec3(a - by * along));
  capsule.b = pack(Vec3(b + by * along));
  return capsule;
}

}  // namespace palpa::measure
