#pragma once

#include <array>
#include <cmath>
#include <numbers>

#include "anatomy/base/random.h"
#include "haptics/sensors/tool_load.h"

namespace palpa::haptics {

/// A value with its first and second time derivative.
template <class T>
struct Jet {
  T x, v, a;
};

inline Jet<Mat3> operator*(const Jet<Mat3>& l, const Jet<Mat3>& r) {
  return {l.x * r.x, l.v * r.x + l.x * r.v, l.a * r.x + 2 * l.v * r.v + l.x * r.a};
}

/// Sum of three sines below 4 Hz.
struct Sway {
  std::array<double, 3> amplitude{}, omega{}, phase{};
  Sway() = default;
  Sway(double size, RandomStream& random) {
    for (std::size_t i = 0; i < 3; ++i) {
      amplitude[i] = size * random.uniform(0.2, 1) / 3;
      omega[i] = 2 * std::numbers::pi * random.uniform(0.3, 4);
      phase[i] = random.uniform(0, 6);
    }
  }
  Jet<double> at(double t) const {
    Jet<double> s{0, 0, 0};
    for (std::size_t i = 0; i < 3; ++i) {
      const double w = omega[i], sine = amplitude[i] * std::sin(w * t + phase[i]);
      s.x += sine;
      s.v += w * amplitude[i] * std::cos(w * t + phase[i]);
      s.a -= w * w * sine;
    }
    return s;
  }
};

inline Jet<Mat3> turn(const Vec3& axis, const Jet<double>& angle) {
  Mat3 K;
  K << 0, -axis.z(), axis.y(), axis.z(), 0, -axis.x(), -axis.y(), axis.x(), 0;
  const Mat3 R = Eigen::AngleAxisd(angle.x, axis).toRotationMatrix();
  return {R, K * R * angle.v, K * R * angle.a + K * K * R * angle.v * angle.v};
}

/// A tool of point masses, waved about with known derivatives. What its sensor measures comes from
/// Newton's law for each point: no inertia tensor and no angular velocity in it.
class MovingTool {
 public:
  /// `heavy`: 1: some 150 g.
  explicit MovingTool(std::uint64_t seed, double heavy = 1) {
    RandomStream random(seed, "moving tool");
    for (Sway& s : place_) s = Sway(0.06, random);
    for (Sway& s : angle_) s = Sway(2.0, random);
    for (std::size_t i = 0; i < kPoints; ++i) {
      mass_[i] = heavy * random.uniform(0.01, 0.05);
      for (int k = 0; k < 3; ++k) p_S_[i][k] = random.uniform(-0.03, 0.03);
      p_S_[i].z() += 0.05;
    }
  }

  ToolLoad load() const {
    ToolLoad tool;
    Vec3 moment = Vec3::Zero();
    for (std::size_t i = 0; i < kPoints; ++i) {
      tool.mass += mass_[i];
      moment += mass_[i] * p_S_[i];
    }
    tool.p_SM = pack(Vec3(moment / tool.mass));
    Mat3 J = Mat3::Zero();
    for (std::size_t i = 0; i < kPoints; ++i) {
      const Vec3 d = p_S_[i] - unpack(tool.p_SM);
      J += mass_[i] * (d.squaredNorm() * Mat3::Identity() - d * d.transpose());
    }
    tool.inertia = {J(0, 0), J(1, 1), J(2, 2), J(0, 1), J(0, 2), J(1, 2)};
    return tool;
  }

  PackedPose pose(double t) const {
    return {pack(Vec3(place_[0].at(t).x, place_[1].at(t).x, place_[2].at(t).x)),
            pack(Quat(rotation(t).x).normalized())};
  }

  /// Measured at `t` with `contact` acting on the tool: what the tool exerts on the sensor.
  Wrench measured(double t, const Wrench& contact, const Vec3& g_W) const {
    const Jet<Mat3> R = rotation(t);
    const Vec3 a_W(place_[0].at(t).a, place_[1].at(t).a, place_[2].at(t).a);
    Vec3 f = unpack(contact.f_S), tau = unpack(contact.tau_S);
    for (std::size_t i = 0; i < kPoints; ++i) {
      const Vec3 a_point_W = a_W + R.a * p_S_[i];
      const Vec3 share = mass_[i] * (R.x.transpose() * (g_W - a_point_W));
      f += share;
      tau += p_S_[i].cross(share);
    }
    return {pack(f), pack(tau)};
  }

 private:
  static constexpr std::size_t kPoints = 5;
  Jet<Mat3> rotation(double t) const {
    return turn(Vec3::UnitZ(), angle_[0].at(t)) * turn(Vec3::UnitY(), angle_[1].at(t)) *
           turn(Vec3::UnitX(), angle_[2].at(t));
  }
  std::array<Sway, 3> place_, angle_;
  std::array<double, kPoints> mass_{};
  std::array<Vec3, kPoints> p_S_{};
};

}  // namespace palpa::haptics
