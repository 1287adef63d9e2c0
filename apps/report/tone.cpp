#include "apps/report/tone.h"

#include <map>

namespace palpa::report {

const char* cssClass(Tone tone) {
  switch (tone) {
    case Tone::good:
      return "good";
    case Tone::guide:
      return "guide";
    case Tone::bad:
      return "bad";
    case Tone::neutral:
      break;
  }
  return "plain";
}

Tone toneOfSpan(const std::string& kind) {
  if (kind == "good") return Tone::good;
  if (kind == "guide") return Tone::guide;
  return kind == "bad" ? Tone::bad : Tone::neutral;
}

Tone toneOfMoment(const std::string& kind) {
  static const std::map<std::string, Tone> kTones{
      {"vein", Tone::good},     {"flash", Tone::good},  {"success", Tone::good},
      {"good", Tone::good},     {"bone", Tone::guide},  {"clavicle", Tone::guide},
      {"guide", Tone::guide},   {"lung", Tone::bad},    {"pleura", Tone::bad},
      {"artery", Tone::bad},    {"rib", Tone::bad},     {"sternum", Tone::bad},
      {"back_wall", Tone::bad}, {"through", Tone::bad}, {"bad", Tone::bad},
      {"safety", Tone::bad}};
  const auto found = kTones.find(kind);
  return found == kTones.end() ? Tone::neutral : found->second;
}

}  // namespace palpa::report
