#include <algorithm>
#include <cmath>

#include "apps/assess/explanations.h"
#include "apps/assess/wording.h"

namespace palpa::assess {
namespace {

std::string injuries(const TrialReview& r) {
  std::vector<std::string> parts;
  if (!r.lung.empty())
    parts.push_back("the lung was punctured");
  else if (!r.lung_touched.empty())
    parts.push_back("the pleura was touched");
  if (entersArtery(r.samples))
    parts.push_back("the artery was punctured");
  else if (!r.artery.empty())
    parts.push_back("the artery was touched");
  if (piercesBackWall(r.samples)) parts.push_back("the vein's back wall was pierced");
  if (!r.ribcage.empty()) parts.push_back("the ribcage was struck");
  if (!r.clavicle_struck.empty()) parts.push_back("the clavicle was pressed too hard");
  return list(parts);
}

std::string outcomeWords(const TrialFacts& facts, const TrialReview& r) {
  if (r.success) return "Vein reached in " + seconds(r.end_s);
  if (facts.outcome == "time") return "Vein not reached within " + seconds(r.end_s);
  if (facts.outcome == "passes")
    return "Vein not reached when a pass too many began, after " + seconds(r.end_s);
  if (facts.outcome == "aborted") return "Stopped after " + seconds(r.end_s) + ", vein not reached";
  if (facts.outcome == "void") return "Trial void after " + seconds(r.end_s);
  return "Ended after " + seconds(r.end_s) + ", vein not reached";
}

const char* plainName(const std::string& code) {
  if (code == "COL_LUNG") return "contact with the lung";
  if (code == "COL_RIB") return "contact with bone";
  if (code == "COL_ART") return "contact with the artery";
  if (code == "COL_VEIN") return "needless contact with the vein";
  if (code == "PHASE_1") return "entry point and depth";
  if (code == "PHASE_2") return "direction of the needle";
  if (code == "ECON_MEAN") return "distance from the taught line";
  if (code == "ECON_VAR") return "unsteady needle";
  return "time";
}

}  // namespace

std::string summarise(const TrialFacts& facts, const TrialReview& r,
                      const std::vector<Penalty>& penalties) {
  std::string text = outcomeWords(facts, r);
  const std::string harm = injuries(r);
  if (harm.empty())
    text += r.success ? " with no injury." : ". No injury.";
  else
    text += (r.success ? ", but " : "; ") + harm + ".";
  if (!r.pass) return text + " The skin was not punctured.";
  const auto largest =
      std::max_element(penalties.begin(), penalties.end(),
                       [](const Penalty& a, const Penalty& b) { return a.points < b.points; });
  if (largest != penalties.end() && largest->points > 0)
    text += std::string(" Largest penalty: ") + plainName(largest->code) + " (" +
            std::to_string(std::lround(largest->points)) + " points).";
  return text;
}

}  // namespace palpa::assess
