#include "apps/evidence/likeness.h"

#include <algorithm>
#include <cmath>

#include <nlohmann/json.hpp>

#include "anatomy/base/json_text.h"

namespace palpa::evidence {

Likeness likeness(double recorded, double again) {
  if (recorded == again || (std::isnan(recorded) && std::isnan(again))) return Likeness::same_bits;
  const double most = kRounding * std::max({1.0, std::abs(recorded), std::abs(again)});
  return std::abs(recorded - again) <= most && std::isfinite(most) ? Likeness::rounding
                                                                   : Likeness::changed;
}

namespace {

Likeness likenessOfValues(const nlohmann::json& recorded, const nlohmann::json& again) {
  if (recorded.is_number() && again.is_number())
    return likeness(recorded.get<double>(), again.get<double>());
  if (recorded.type() != again.type() || recorded.size() != again.size()) return Likeness::changed;
  if (!recorded.is_structured()) return recorded == again ? Likeness::same_bits : Likeness::changed;
  Likeness worst = Likeness::same_bits;
  for (auto a = recorded.begin(), b = again.begin(); a != recorded.end(); ++a, ++b) {
    if (recorded.is_object() && a.key() != b.key()) return Likeness::changed;
    worst = worse(worst, likenessOfValues(*a, *b));
  }
  return worst;
}

}  // namespace

Likeness likenessOfJson(const std::string& recorded, const std::string& again) {
  return likenessOfValues(parseJson(recorded), parseJson(again));
}

}  // namespace palpa::evidence
