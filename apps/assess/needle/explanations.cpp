#include <algorithm>
#include <cmath>

#include "apps/assess/needle/wording.h"
#include "apps/training/trial_words.h"

namespace palpa::assess {

using training::Outcome;

namespace {

Penalty line(const char* code, const char* title, double value, double weight, std::string sentence,
             const std::vector<Interval>& stretches, const char* unit = "samples") {
  return {code,   title,          std::move(sentence), value,
          weight, weight * value, startsOf(stretches), unit};
}

std::vector<Interval> inOrder(std::vector<Interval> a, const std::vector<Interval>& b) {
  a.insert(a.end(), b.begin(), b.end());
  std::sort(a.begin(), a.end(),
            [](const Interval& x, const Interval& y) { return x.from_s < y.from_s; });
  return a;
}

/// A contact between two scoring samples leaves no count; it must not be passed over in silence.
std::string tooShort(double value) { return value > 0 ? "" : " Too short to be counted."; }

Penalty lung(const TrialReview& r, const ScoringRules& rules) {
  std::string sentence = "No contact with the lung.";
  if (!r.lung.empty())
    sentence = "The needle was in the lung " + duration(r.lung);
  else if (!r.lung_touched.empty())
    sentence = "The needle pressed on the pleura " + duration(r.lung_touched);
  if (!r.lung.empty() && r.pleura_miss.distance < 0)
    sentence += ", up to " + millimetres(-r.pleura_miss.distance) + " past the pleura";
  if (!r.lung_touched.empty()) sentence += ": risk of pneumothorax." + tooShort(r.values.col_lung);
  return line("COL_LUNG", r.lung_touched.empty() ? "Lung spared" : "Lung touched",
              r.values.col_lung, rules.weights.lung, sentence, r.lung_touched);
}

std::string guidance(const TrialReview& r) {
  if (r.clavicle.empty()) return "No bone touched; the clavicle was not used as a guide.";
  return "The clavicle guided the needle for " + seconds(heldTime(r.clavicle)) + " with at most " +
         newtons(peakBoneForce(r.samples, r.clavicle)) + "; no other bone touched.";
}

std::string upTo(const TrialReview& r, const std::vector<Interval>& stretches) {
  return " (up to " + newtons(peakBoneForce(r.samples, stretches)) + ").";
}

std::string struckBone(Organ organ) {
  switch (organ) {
    case Organ::rib:
      return "A rib";
    case Organ::cartilage:
      return "The cartilage of a rib";
    default:
      return std::string("The ") + name(organ);
  }
}

Penalty bone(const TrialReview& r, const ScoringRules& rules) {
  std::string sentence;
  if (!r.ribcage.empty()) {
    sentence = struckBone(r.samples[r.ribcage.front().first].bone) + " was struck " +
               duration(r.ribcage) + upTo(r, r.ribcage);
  }
  if (!r.clavicle_struck.empty())
    sentence += std::string(sentence.empty() ? "" : " ") +
                "The clavicle was pressed harder than the " + newtons(rules.clavicle_guide_N) +
                " of a guide " + duration(r.clavicle_struck) + upTo(r, r.clavicle_struck);
  const bool clean = sentence.empty();
  return line("COL_RIB", clean ? "Bone spared" : "Bone struck", r.values.col_rib, rules.weights.rib,
              clean ? guidance(r) : sentence + tooShort(r.values.col_rib),
              inOrder(r.ribcage, r.clavicle_struck),
              rules.bone_unit == BoneUnit::samples ? "samples" : "contacts");
}

Penalty artery(const TrialReview& r, const ScoringRules& rules) {
  std::string sentence = "No contact with an artery.";
  if (!r.artery.empty()) {
    sentence = (entersArtery(r.samples) ? "The needle was in the artery or its wall "
                                        : "The needle pressed on the wall of the artery ") +
               duration(r.artery) + "." + tooShort(r.values.col_art);
  }
  return line("COL_ART", r.artery.empty() ? "Artery spared" : "Artery touched", r.values.col_art,
              rules.weights.artery, sentence, r.artery);
}

Penalty vein(const TrialReview& r, const ScoringRules& rules) {
  std::string sentence;
  if (!r.vein_unneeded.empty())
    sentence = std::string("The vein was touched ") +
               (r.success ? "outside the final entry " : "without success ") +
               duration(r.vein_unneeded) + ".";
  if (!r.back_wall.empty())
    sentence += (sentence.empty() ? "The back wall of the vein" : " Its back wall") +
                std::string(" was touched from inside ") + duration(r.back_wall) +
                (piercesBackWall(r.samples) ? " and pierced." : ".");
  const bool clean = sentence.empty();
  if (clean)
    sentence = r.success ? "The vein was touched only to enter it." : "The vein was not touched.";
  else
    sentence += tooShort(r.values.col_vein);
  return line("COL_VEIN", clean ? "Vein spared" : "Vein touched needlessly", r.values.col_vein,
              rules.weights.vein, sentence, inOrder(r.vein_unneeded, r.back_wall));
}

}  // namespace

std::vector<Penalty> explainCollisions(const TrialReview& r, const ScoringRules& rules) {
  std::vector<Penalty> lines;
  if (r.has_lung) lines.push_back(lung(r, rules));
  lines.push_back(bone(r, rules));
  if (r.has_artery) lines.push_back(artery(r, rules));
  lines.push_back(vein(r, rules));
  return lines;
}

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
  if (r.success) return "Vein reached in " + seconds(r.time_s());
  if (facts.outcome == Outcome::mistaken)
    return "What was aspirated was not recognised, after " + seconds(r.end_s);
  if (facts.outcome == Outcome::time) return "Vein not reached within " + seconds(r.end_s);
  if (facts.outcome == Outcome::passes)
    return "Vein not reached when a pass too many began, after " + seconds(r.end_s);
  if (facts.outcome == Outcome::aborted)
    return "Stopped after " + seconds(r.end_s) + ", vein not reached";
  if (facts.outcome == Outcome::voided) return "Trial void after " + seconds(r.end_s);
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
