#include "apps/assess/needle/technical_errors.h"

#include <algorithm>
#include <cmath>

#include "anatomy/base/pinned_math.h"
#include "apps/assess/needle/wording.h"

namespace palpa::assess {
namespace {

constexpr double kAimRate_Hz = 5;              // the way between two looks is longer than a tremor
constexpr double kAimSpeed = 0.001;            // m/s: slower, the needle is held
constexpr double kSteepest = 65 * M_PI / 180;  // beyond, "toward the head" means little
constexpr double kToDegrees = 180 / M_PI;

/// Something that happened several times; the worst stands for all.
struct Worst {
  int times = 0;
  double value = 0, t_s = 0;
  void add(double v, double t) {
    ++times;
    if (times == 1 || std::abs(v) > std::abs(value)) value = v, t_s = t;
  }
};

std::string often(int times) {
  return times > 1 ? " (" + std::to_string(times) + " times; this was the worst)" : "";
}

/// Advanced in a direction beyond a limit, in one pass.
struct Astray {
  double travel = 0, weighted = 0, t_s = -1;
  void add(double beyond, double step, double t) {
    if (t_s < 0) t_s = t;
    travel += step;
    weighted += step * beyond;
  }
  double mean() const { return travel > 0 ? weighted / travel : 0; }
};

/// Visits the steps by which the needle was advanced toward the vein, `look(aim, metres, t_s)`.
template <class Look>
void eachAdvance(const TrialReview& r, const Pass& pass, const anatomy::LandmarkFrame& frame,
                 const calibration::TaughtPath& path, Look look) {
  if (!pass.advanced || pass.phase_2 >= r.samples.size()) return;
  const Samples phase_2 = r.samples.subspan(pass.phase_2, pass.last - pass.phase_2 + 1);
  const std::vector<std::size_t> looks = scoringSamples(phase_2, kAimRate_Hz);
  for (std::size_t k = 1; k < looks.size(); ++k) {
    const TrialSample &a = phase_2[looks[k - 1]], &b = phase_2[looks[k]];
    const Vec3 axis = (a.axis_A + b.axis_A).normalized();
    const double step = (b.tip_A - a.tip_A).dot(axis);
    if (inVein(a) || inVein(b) || step < kAimSpeed * (b.t_s - a.t_s)) continue;
    look(aimOf(axis, frame, path), step, a.t_s);
  }
}

/// The worst pass advanced beyond `limit`, as `part` of its aim says.
template <class Part>
std::pair<Worst, double> astray(const TrialReview& r, const anatomy::LandmarkFrame& frame,
                                const calibration::TaughtPath& path, double limit,
                                double least_travel, Part part) {
  Worst worst;
  double travel = 0;
  for (const Pass& pass : r.history.passes) {
    Astray pass_astray;
    eachAdvance(r, pass, frame, path, [&](const Aim& aim, double step, double t) {
      if (const double beyond = part(aim); beyond > limit) pass_astray.add(beyond, step, t);
    });
    if (pass_astray.travel < least_travel) continue;
    worst.add(pass_astray.mean(), pass_astray.t_s);
    if (worst.t_s == pass_astray.t_s) travel = pass_astray.travel;
  }
  return {worst, travel};
}

using Errors = std::vector<TechnicalError>;

void site(const TrialReview& r, const std::vector<Vec3>& offsets_L, const ErrorRules& rules,
          Errors* errors) {
  Worst worst;
  for (std::size_t i = 0; i < offsets_L.size(); ++i)
    if (std::abs(offsets_L[i].z()) > rules.site_off)
      worst.add(offsets_L[i].z(), r.history.passes[i].puncture.t_s);
  if (!worst.times) return;
  const bool near = worst.value > 0;
  errors->push_back(
      {"site", "Wrong site relative to the clavicle",
       "The skin was punctured " + millimetres(std::abs(worst.value)) +
           (near ? " too close to the clavicle" : " too far below the clavicle") + ", at " +
           seconds(worst.t_s) + " (an error from " + millimetres(rules.site_off) + " on)" +
           often(worst.times) +
           (near ? ": from there the needle meets the bone instead of passing behind it."
                 : ": from there the way behind the bone is long and leads toward the ribs and the "
                   "lung."),
       worst.t_s, 1e3 * std::abs(worst.value), 1e3 * rules.site_off, "mm", worst.times});
}

void landmarks(const TrialReview& r, const std::vector<Vec3>& offsets_L,
               const anatomy::LandmarkFrame& frame, const calibration::TaughtPath& path,
               const ErrorRules& rules, Errors* errors) {
  const char* const title = "Landmarks not identified";
  Worst along;
  for (std::size_t i = 0; i < offsets_L.size(); ++i)
    if (std::abs(offsets_L[i].x()) > rules.landmark_off)
      along.add(offsets_L[i].x(), r.history.passes[i].puncture.t_s);
  if (along.times) {
    errors->push_back(
        {"landmarks", title,
         "The skin was punctured " + millimetres(std::abs(along.value)) +
             (along.value > 0 ? " too far toward the breastbone" : " too far toward the shoulder") +
             ", at " + seconds(along.t_s) + " (an error from " + millimetres(rules.landmark_off) +
             " on)" + often(along.times) +
             ": the junction of the clavicle's medial and middle thirds was missed.",
         along.t_s, 1e3 * std::abs(along.value), 1e3 * rules.landmark_off, "mm", along.times});
    return;
  }
  const auto [caudal, travel] = astray(r, frame, path, rules.too_caudal, rules.aim_travel,
                                       [](const Aim& a) { return -a.more_cephalad; });
  if (!caudal.times) return;
  errors->push_back(
      {"landmarks", title,
       "The needle was aimed " + degrees(caudal.value) + " too far toward the feet over " +
           millimetres(travel) + ", from " + seconds(caudal.t_s) + " on (an error from " +
           degrees(rules.too_caudal) + " on)" + often(caudal.times) +
           ": the suprasternal notch, which it is aimed at, was missed.",
       caudal.t_s, kToDegrees * caudal.value, kToDegrees * rules.too_caudal, "deg", caudal.times});
}

void periosteum(const TrialReview& r, const ErrorRules& rules, Errors* errors) {
  const auto pressed = intervals(r.samples, [&](const TrialSample& s) {
    return touchesClavicle(s) && s.phase == haptics::NeedlePhase::inserted &&
           s.bone_force > rules.periosteum_N;
  });
  Worst worst;
  double held = 0;
  for (const Interval& one : pressed) {
    if (one.held_s < rules.periosteum_s) continue;
    worst.add(peakBoneForce(r.samples, {one}), one.from_s);
    held += one.held_s;
  }
  if (!worst.times) return;
  errors->push_back({"periosteum", "Through the periosteum of the clavicle",
                     "The needle was pressed into the clavicle with up to " + newtons(worst.value) +
                         ", at " + seconds(worst.t_s) + ", for " + seconds(held) +
                         " in all (an error from " + newtons(rules.periosteum_N) + " on)" +
                         often(worst.times) +
                         ": it goes through the periosteum, hurts, and blocks; lower the needle "
                         "and pass behind the bone.",
                     worst.t_s, worst.value, rules.periosteum_N, "N", worst.times});
}

void aims(const TrialReview& r, const anatomy::LandmarkFrame& frame,
          const calibration::TaughtPath& path, const ErrorRules& rules, Errors* errors) {
  const auto [flat, flat_way] = astray(r, frame, path, rules.too_shallow, rules.aim_travel,
                                       [](const Aim& a) { return -a.steeper; });
  if (flat.times)
    errors->push_back(
        {"shallow", "Too flat",
         "The needle was led " + degrees(flat.value) + " too flat over " + millimetres(flat_way) +
             ", from " + seconds(flat.t_s) + " on (an error from " + degrees(rules.too_shallow) +
             " on)" + often(flat.times) + ": it runs onto the bone or passes in front of the vein.",
         flat.t_s, kToDegrees * flat.value, kToDegrees * rules.too_shallow, "deg", flat.times});
  const auto [high, high_way] = astray(r, frame, path, rules.too_cephalad, rules.aim_travel,
                                       [](const Aim& a) { return a.more_cephalad; });
  if (high.times)
    errors->push_back({"cephalad", "Too cephalad",
                       "The needle was aimed " + degrees(high.value) +
                           " too far toward the head over " + millimetres(high_way) + ", from " +
                           seconds(high.t_s) + " on (an error from " + degrees(rules.too_cephalad) +
                           " on)" + often(high.times) + ": there lies the artery, not the vein.",
                       high.t_s, kToDegrees * high.value, kToDegrees * rules.too_cephalad, "deg",
                       high.times});
}

double bloodIn(const TrialReview& r, const Interval& stay, const ScoringRules& rules) {
  double blood = 0;
  for (std::size_t i = stay.first; i <= stay.last && i + 1 < r.samples.size(); ++i)
    if (aspirates(r.samples[i], rules)) blood += r.samples[i + 1].t_s - r.samples[i].t_s;
  return blood;
}

void leftVein(const TrialReview& r, const ScoringRules& rules, Errors* errors) {
  int times = 0;
  double least = 0, at = 0;
  bool through = false;
  for (const Interval& stay : r.vein_lumen) {
    const double blood = bloodIn(r, stay, rules);
    if (stay.last + 1 >= r.samples.size() || blood < rules.errors.blood_s || blood >= rules.dwell_s)
      continue;
    if (++times > 1) continue;
    least = blood;
    at = r.samples[stay.last + 1].t_s;
    const TrialSample& out = r.samples[stay.last + 1];
    through = out.wall == Organ::vein && out.wall_leaving;
  }
  if (!times) return;
  errors->push_back(
      {"left_vein", "Needle left the vein",
       "Blood had come for " + seconds(least) + " when the needle left the vein" +
           (through ? " through its back wall" : "") + ", at " + seconds(at) +
           " (it must flow for " + seconds(rules.dwell_s) + ")" +
           (times > 1 ? ", and " + std::to_string(times - 1) + " more time" + (times > 2 ? "s" : "")
                      : "") +
           ": a wire would not have found the vein. Hold the hub still as soon as blood comes.",
       at, least, rules.dwell_s, "s", times});
}

}  // namespace

Aim aimOf(const Vec3& axis_A, const anatomy::LandmarkFrame& frame,
          const calibration::TaughtPath& path) {
  const DirectionError error = comparedWith(frame.vectorToLandmarks(axis_A), path);
  const double elevation = pinned::asin(std::clamp(frame.vectorToLandmarks(axis_A).y(), -1.0, 1.0));
  return {error.steeper, std::abs(elevation) > kSteepest ? 0 : error.more_cephalad};
}

std::vector<TechnicalError> technicalErrors(const TrialReview& r,
                                            const anatomy::LandmarkFrame& frame,
                                            const calibration::TaughtPath& path,
                                            const ScoringRules& rules) {
  std::vector<Vec3> offsets_L;
  for (const Pass& pass : r.history.passes)
    offsets_L.push_back(frame.pointToLandmarks(pass.puncture.tip_A) - path.entry_L);
  Errors errors;
  landmarks(r, offsets_L, frame, path, rules.errors, &errors);
  site(r, offsets_L, rules.errors, &errors);
  periosteum(r, rules.errors, &errors);
  aims(r, frame, path, rules.errors, &errors);
  leftVein(r, rules, &errors);
  return errors;
}

}  // namespace palpa::assess
