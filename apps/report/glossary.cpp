#include "apps/report/glossary.h"

namespace palpa::report {
namespace {

constexpr Code kCodes[] = {
    {"COL_LUNG", "samples",
     "Scoring samples, 20 a second, in which the needle was in contact with the lung."},
    {"COL_RIB", "samples",
     "The same for ribs and skeleton. Touching the clavicle lightly to find the way beneath it "
     "does "
     "not count."},
    {"COL_ART", "samples", "The same for arteries."},
    {"COL_VEIN", "samples",
     "Contact with the vein other than the successful entry and aspiration; its back wall always "
     "counts."},
    {"PHASE_1", "mm",
     "Insertion: distance of the entry point from the optimum, plus the error in depth before the "
     "needle is turned."},
    {"PHASE_2", "",
     "Direction: deviation of the turned needle from the optimum. 1000 is the edge of what is "
     "acceptable; below it nothing is charged."},
    {"ECON_MEAN", "mm",
     "Economy of movement: mean distance of the needle from the optimal line while it is "
     "advanced."},
    {"ECON_VAR", "mm²",
     "Economy of movement: variance of that distance; a steady hand has little."},
    {"TIME", "ms", "From the start of the trial to its end."},
    {"TOTAL", "points", "Sum of weight × value over all of the above. Lower is better."}};

}  // namespace

std::string_view unitOf(const std::string& code) {
  for (const Code& entry : kCodes) {
    if (entry.code == code) return entry.unit;
  }
  return "";
}

void writeGlossary(Html& html) {
  html.element("h2", "What these numbers mean");
  {
    const auto list = html.in("dl", {{"class", "glossary"}});
    for (const Code& entry : kCodes) {
      html.element("dt", entry.code);
      html.element("dd", entry.meaning);
    }
  }
  html.element(
      "p", {{"class", "muted"}},
      "Source: C. S. Tzafestas, K. Birbas, Y. Koumpouros, D. Christopoulos: Pilot Evaluation "
      "Study of a Virtual Paracentesis Simulator for Skill Training and Assessment: The "
      "Beneficial Effect of Haptic Display. Presence 17(2), 212–229, 2008.");
}

}  // namespace palpa::report
