#include "apps/assess/paracentesis_score.h"

namespace palpa::assess {

double total(const ParacentesisValues& v, const ScoreWeights& w) {
  return w.lung * v.col_lung + w.rib * v.col_rib + w.artery * v.col_art + w.vein * v.col_vein +
         w.phase_1 * v.phase_1 + w.phase_2(v.phase_2) * v.phase_2 + w.econ_mean * v.econ_mean +
         w.econ_var * v.econ_var + w.time * v.time_ms;
}

}  // namespace palpa::assess
