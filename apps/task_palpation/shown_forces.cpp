#include "apps/task_palpation/shown_forces.h"

namespace palpa::task_palpation {

std::vector<scene::ForceArrow> shownForces(const runtime::ToolState& tool, const Mat3& R_AD,
                                           const Pose& X_AT, bool apart) {
  constexpr double kShown_N = 0.05;
  const Vec3 f_real_A = R_AD * unpack(tool.f_sensed_D),
             f_device_A = R_AD * unpack(tool.f_command_D), at_handle_T(0, 0, -0.11);
  std::vector<scene::ForceArrow> all;
  const auto show = [&](scene::ForceKind kind, const Vec3& p_A, const Vec3& f_A) {
    if (f_A.norm() > kShown_N) all.push_back({kind, p_A, f_A});
  };
  show(scene::ForceKind::reaction, X_AT.translation(),
       apart ? f_real_A : Vec3(f_real_A + f_device_A));
  if (apart) show(scene::ForceKind::device, X_AT * at_handle_T, f_device_A);
  return all;
}

}  // namespace palpa::task_palpation
