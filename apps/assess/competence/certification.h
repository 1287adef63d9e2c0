#pragma once

#include <string>
#include <vector>

#include "apps/assess/statistics/cusum.h"

namespace palpa::competence {

/// How many trials it takes to certify somebody by the sequential test, at rates of failure that an
/// educator may choose; none is established for this procedure.
struct Certification {
  statistics::CusumRates rates;
  statistics::CusumLimits limits;
};

/// 10/25, 10/20, 5/15 and 5/10 % with chances of error of 0.1.
std::vector<Certification> certifications();

/// What `trials` trials cannot certify, in a sentence: "1 trial cannot certify anybody: ... at
/// least 13 trials in a row without a failure ...".
std::string whatCannotBeCertified(int trials);

}  // namespace palpa::competence
