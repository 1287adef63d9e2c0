#include "apps/twin/needle_plan.h"

#include <algorithm>
#include <cmath>
#include <string>

namespace palpa::twin {

NeedlePlan::NeedlePlan(const OperatorSkill& skill, const VisibleAnatomy& anatomy,
                       std::uint64_t seed)
    : skill_(skill), anatomy_(anatomy), seed_(seed), judgement_(seed, "operator.judgement.0") {}

void NeedlePlan::begin(int trial) {
  judgement_ = RandomStream(seed_, "operator.judgement." + std::to_string(trial));
  auto& j = judgement_;
  entry_A_ = anatomy_.entry_A +
             skill_.entry_sd * (j.normal() * anatomy_.medial_A + j.normal() * anatomy_.cephalad_A);
  normal_A_ = (anatomy_.normal_A + skill_.normal_sd * (j.normal() * anatomy_.medial_A +
                                                       j.normal() * anatomy_.cephalad_A))
                  .normalized();
  depth_error_ = j.normal(0, skill_.depth_sd);
  // Bevel up: toward the front of the patient who lies there, and a little to the head, which is up
  // while the needle stands on the skin. About the way to the middle of the body it is turned by
  // chance.
  RandomStream chance(seed_, "operator.bevel." + std::to_string(trial));
  bevel_A_ = Eigen::AngleAxisd(skill_.bevel_sd * chance.normal(), anatomy_.medial_A) *
             (0.3 * anatomy_.cephalad_A - anatomy_.posterior_A);
}

Vec3 NeedlePlan::firstAim(const Vec3& entered_A, bool feels) {
  const Vec3 aim = (anatomy_.aim_A - entered_A).normalized();
  const Vec3 to_bone = (anatomy_.cephalad_A - anatomy_.posterior_A).normalized();
  const double lean = std::min(feels ? skill_.guide : skill_.guide_unfelt, anatomy_.most_lean);
  return (aim + std::tan(lean) * to_bone +
          skill_.direction_sd * (judgement_.normal() * anatomy_.posterior_A +
                                 judgement_.normal() * anatomy_.cephalad_A))
      .normalized();
}

Vec3 NeedlePlan::redirected(const Vec3& axis_A, const Vec3& toward_A, int passes) {
  const Vec3 pattern[] = {anatomy_.posterior_A, anatomy_.cephalad_A, -anatomy_.posterior_A,
                          -anatomy_.cephalad_A};
  const Vec3 wanted = toward_A.isZero() ? pattern[passes % 4] : toward_A;
  const Vec3 toward = (wanted - wanted.dot(axis_A) * axis_A).normalized();
  const double angle = skill_.redirect + skill_.redirect_sd * judgement_.normal();
  return (std::cos(angle) * axis_A + std::sin(angle) * toward).normalized();
}

}  // namespace palpa::twin
