#include "apps/bench/pictures/session_frames.h"

#include <cmath>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <numbers>

#include "apps/bench/bench_patients.h"

namespace palpa::bench {

void leaveOutDrawing() {
  setenv("LIBGL_ALWAYS_SOFTWARE", "1", 1);
  setenv("GALLIUM_NOOP", "1", 1);
}

std::size_t trianglesOf(const anatomy::Patient& patient) {
  std::size_t all = 0;
  for (const anatomy::OrganSurface& organ : patient.organs) all += organ.mesh.triangles.size();
  return all;
}

scene::CameraLook SessionFrames::usualLook() {
  return {.blur_px = 0.7,
          .black = {0.1, 0.1, 0.1},
          .white = {0.9, 0.9, 0.9},
          .grain = {0.01, 0.01, 0.01, 0.01, 0.01}};
}

SessionFrames::SessionFrames(const anatomy::Patient& patient)
    : picture_{kWidth, kHeight, 3,
               std::vector<std::uint8_t>(std::size_t{3} * kWidth * kHeight, 120)},
      entry_A_(patient.landmark(anatomy::landmark::kEntry)) {
  state_.picture = &picture_;
  state_.registered = true;
  state_.camera = {kWidth, kHeight, 600, 600, 319.5, 239.5};
  state_.look = usualLook();
}

double SessionFrames::work(int i) {
  const double sway = std::sin(0.1 * i);
  state_.X_AT = makePose(Quat(Eigen::AngleAxisd(-1.2, Vec3::UnitX())).toRotationMatrix(),
                         entry_A_ + Vec3(0, 0.01 * sway, 0));
  state_.forces = {{scene::ForceKind::reaction, state_.X_AT.translation(), Vec3(0, -1 - sway, 0)}};
  state_.hud.phase = "phase 2: advance to the vein";
  char force[16];
  std::snprintf(force, sizeof force, "%.1f N",
                1 + 0.01 * (i / 6 % 10));  // words change a few times a second
  state_.hud.force = force;
  return sway;
}

const scene::SceneState& SessionFrames::at(int i) {
  const double sway = work(i);
  for (std::size_t k = 0; k < picture_.pixels.size(); k += 97)
    picture_.pixels[k] = static_cast<std::uint8_t>(i);
  state_.X_CA = lookAt(entry_A_ + Vec3(0.002 * sway + sideways_, -0.45, 0.10), entry_A_);
  return state_;
}

const scene::SceneState& SessionFrames::forEyes(int i, double t_s, int width, int height) {
  constexpr double kTangent = 1.1;  // of half the width and half the height an eye sees
  constexpr double kBetween = 0.063;
  work(i);
  const double turns = 2 * std::numbers::pi * t_s;
  const Vec3 head =
      entry_A_ + Vec3(0.028 * std::sin(0.25 * turns), -0.45 + 0.02 * std::sin(0.1 * turns),
                      0.10 + 0.02 * std::sin(0.17 * turns));
  const Pose X_CA = lookAt(head, entry_A_);
  std::array<scene::EyeCamera, 2> eyes;
  for (std::size_t eye = 0; eye < 2; ++eye) {
    eyes[eye].camera = {width,
                        height,
                        0.5 * width / kTangent,
                        0.5 * height / kTangent,
                        0.5 * (width - 1),
                        0.5 * (height - 1)};
    eyes[eye].X_CA = X_CA;
    eyes[eye].X_CA.translation().x() += eye == 0 ? 0.5 * kBetween : -0.5 * kBetween;
  }
  state_.picture = nullptr;
  state_.camera = eyes[0].camera;
  state_.X_CA = eyes[0].X_CA;
  state_.eyes = eyes;
  return state_;
}

}  // namespace palpa::bench
