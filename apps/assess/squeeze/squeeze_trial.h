#pragma once

#include <array>
#include <cstdint>
#include <string>

namespace palpa::assess {

enum class SqueezedProperty { stiffness, weight };

/// Two things that differed in one property, felt one after the other; which has more of it?
/// Factors: of the real thing's.
struct SqueezeTrial {
  int trial = 0;
  std::string role;  ///< "scored", "not scored"
  bool simulated = false, force_feedback = true;
  std::uint64_t seed = 0;
  std::string outcome;  ///< "done", "time", "aborted", "void"
  SqueezedProperty property = SqueezedProperty::stiffness;
  std::array<double, 2> factors{1, 1};  ///< of the first thing and of the second
  int said = 0;                         ///< which has more: 1 or 2; 0: nothing was said
  double seconds = 0;
  double peak_N = 0;               ///< largest squeezing force that was felt
  std::array<int, 2> grips{0, 0};  ///< how often each was held

  bool answered() const { return outcome == "done" && (said == 1 || said == 2); }
  bool right() const { return answered() && (said == 2) == (factors[1] > factors[0]); }
  double ratio() const {
    return factors[1] > factors[0] ? factors[1] / factors[0] : factors[0] / factors[1];
  }  ///< above 1
};

/// "Right: the second one was harder, by 33 %."
std::string summaryOf(const SqueezeTrial& trial);
/// "harder", "heavier".
const char* moreOf(SqueezedProperty property);

}  // namespace palpa::assess
