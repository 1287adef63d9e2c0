#pragma once

#include <cmath>
#include <numbers>
#include <string>

#include "anatomy/patient.h"

/// Patients made of spheres, tubes and slabs, whose pictures can be computed by hand.
namespace palpa::test {

/// Grid of points p(i, j) with i < rows, j < columns, joined to triangles; `wrap` closes j.
template <class Point, class Normal>
anatomy::TriangleMesh gridMesh(int rows, int columns, bool wrap, Point point, Normal normal) {
  anatomy::TriangleMesh mesh;
  for (int i = 0; i < rows; ++i) {
    for (int j = 0; j < columns; ++j) {
      mesh.points.push_back(point(i, j));
      mesh.normals.push_back(normal(i, j));
    }
  }
  const auto index = [&](int i, int j) {
    return static_cast<std::uint32_t>(i * columns + j % columns);
  };
  for (int i = 0; i + 1 < rows; ++i) {
    for (int j = 0; j < (wrap ? columns : columns - 1); ++j) {
      const auto a = index(i, j), b = index(i, j + 1), c = index(i + 1, j + 1), d = index(i + 1, j);
      mesh.triangles.push_back({a, b, c});
      mesh.triangles.push_back({a, c, d});
    }
  }
  return mesh;
}

inline anatomy::TriangleMesh sphere(const Vec3& centre, const Vec3& radii, int steps = 48) {
  const auto direction = [steps](int i, int j) {
    const double a = std::numbers::pi * i / (steps - 1), b = 2 * std::numbers::pi * j / steps;
    return Vec3(std::sin(a) * std::cos(b), -std::sin(a) * std::sin(b), std::cos(a));
  };
  return gridMesh(
      steps, steps, true,
      [&](int i, int j) { return Vec3(centre + radii.cwiseProduct(direction(i, j))); },
      [&](int i, int j) { return Vec3(direction(i, j).cwiseQuotient(radii).normalized()); });
}

/// Tube about a curve c(t), 0 <= t <= 1.
template <class Curve>
anatomy::TriangleMesh tube(Curve curve, double radius, int rows = 60, int sides = 24) {
  const auto ring = [=](int i, int j) {
    const double t = static_cast<double>(i) / (rows - 1), h = 1e-4;
    const Mat3 R = rotationWithZ((curve(t + h) - curve(t - h)).normalized());
    const double angle = 2 * std::numbers::pi * j / sides;
    return Vec3(R * Vec3(std::cos(angle), std::sin(angle), 0));
  };
  return gridMesh(
      rows, sides, true,
      [&](int i, int j) {
        return Vec3(curve(static_cast<double>(i) / (rows - 1)) + radius * ring(i, j));
      },
      ring);
}

/// Sheet over x in [-half, half], z in [-half, half], at y = height(x, z), seen from -y.
template <class Height>
anatomy::TriangleMesh sheet(double half, Height height, int steps = 60) {
  const auto at = [=](int i) { return half * (2.0 * i / (steps - 1) - 1); };
  return gridMesh(
      steps, steps, false, [&](int i, int j) { return Vec3(at(j), height(at(j), at(i)), at(i)); },
      [&](int i, int j) {
        const double h = 1e-4, x = at(j), z = at(i);
        const double dx = (height(x + h, z) - height(x - h, z)) / (2 * h);
        const double dz = (height(x, z + h) - height(x, z - h)) / (2 * h);
        return Vec3(dx, -1, dz).normalized();
      });
}

inline void add(anatomy::Patient& patient, const std::string& id, Organ organ,
                anatomy::TriangleMesh mesh) {
  patient.organs.push_back({id, organ, std::move(mesh), {1, 1, 1, 1}});
}

/// The region below the right clavicle, roughly: enough to see every colour and every view.
inline anatomy::Patient simplePatient() {
  anatomy::Patient patient;
  patient.name = "spheres and tubes";
  const auto skin = [](double x, double z) { return 0.9 * x * x + 0.35 * z * z - 0.004; };
  add(patient, "skin", Organ::skin, sheet(0.20, skin));
  const auto clavicle = [](double t) {
    return Vec3(-0.02 - 0.145 * t, 0.016 + 0.02 * t + 0.012 * std::sin(6 * t), 0.004 + 0.022 * t);
  };
  const auto vein = [](double t) {
    return Vec3(0.0 - 0.15 * t, 0.028 + 0.012 * t, 0.002 - 0.045 * t + 0.03 * t * (1 - t));
  };
  const auto artery = [](double t) {
    return Vec3(0.0 - 0.15 * t, 0.042 + 0.012 * t, 0.020 - 0.045 * t + 0.035 * t * (1 - t));
  };
  add(patient, "clavicle_right", Organ::clavicle, tube(clavicle, 0.006));
  add(patient, "vein", Organ::vein, tube(vein, 0.0048));
  add(patient, "artery", Organ::artery, tube(artery, 0.0040));
  for (int i = 0; i < 3; ++i) {
    const auto rib = [i](double t) {
      return Vec3(-0.02 - 0.14 * t, 0.020 + 0.06 * t * t, -0.03 - 0.028 * i - 0.05 * t * t);
    };
    add(patient, "rib_" + std::to_string(i + 1), Organ::rib, tube(rib, 0.0055));
  }
  add(patient, "sternum", Organ::sternum, sphere({0, 0.018, -0.06}, {0.018, 0.006, 0.06}));
  add(patient, "lung", Organ::lung, sphere({-0.075, 0.115, -0.09}, {0.06, 0.07, 0.11}));
  const Vec3 entry(-0.068, skin(-0.068, -0.012), -0.012);
  patient.landmarks = {{anatomy::landmark::kNotch, Vec3::Zero()},
                       {anatomy::landmark::kEntry, entry},
                       {anatomy::landmark::kVeinTarget, vein(0.25)}};
  return patient;
}

/// Only a sphere, and nothing before it.
inline anatomy::Patient spherePatient(const Vec3& centre, double radius) {
  anatomy::Patient patient;
  add(patient, "ball", Organ::vein, sphere(centre, Vec3::Constant(radius), 128));
  return patient;
}

}  // namespace palpa::test
