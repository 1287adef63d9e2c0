#include "apps/assess/squeeze/squeeze_trial.h"

#include <cmath>

namespace palpa::assess {

const char* moreOf(SqueezedProperty property) {
  return property == SqueezedProperty::stiffness ? "harder" : "heavier";
}

std::string summaryOf(const SqueezeTrial& trial) {
  if (trial.outcome == "void") return "Void";
  if (!trial.answered())
    return trial.outcome == "time" ? "The time was over before something was said."
                                   : "Nothing was said.";
  const int more = trial.factors[1] > trial.factors[0] ? 2 : 1;
  const std::string which = more == 1 ? "the first one" : "the second one";
  return std::string(trial.right() ? "Right: " : "Wrong: ") + which + " was " +
         moreOf(trial.property) + ", by " + std::to_string(std::lround(100 * (trial.ratio() - 1))) +
         " %.";
}

}  // namespace palpa::assess
