#pragma once

#include <algorithm>
#include <cmath>
#include <string>

#include "apps/report/needle/session_report.h"
#include "apps/training/trial_words.h"
#include "tests/support/files.h"

/// A made-up but plausible session for the tests and for looking at the page.
namespace palpa::report::test {

using palpa::test::slurp;
inline std::filesystem::path freshFolder(const std::string& name) {
  return palpa::test::freshFolder("report", name);
}

/// Skin touched at 5 s, punctured at 6.1 s, turned at 9 s, clavicle felt at 13 s, lung grazed
/// at 18.3 s, vein reached at 26.2 s, aspirated until 31.5 s.
inline assess::TrialSample sampleAt(double t) {
  assess::TrialSample s;
  s.t_s = t;
  const double wobble = 0.05 * std::sin(9 * t) + 0.03 * std::sin(23.7 * t + 1);
  if (t > 5 && t < 6.1) {
    s.f_contact = 1.6 * std::pow((t - 5) / 1.1, 3);
  } else if (t >= 6.1) {
    s.f_contact = 0.45 + wobble + 0.5 * std::exp(-(t - 6.1) / 0.05);
    if (t > 13 && t < 15.2) s.f_contact += 3.6 * std::pow(std::sin((t - 13) / 2.2 * 3.14159), 2);
    if (t > 25.6 && t < 26.2) s.f_contact += 2 * (t - 25.6);
  }
  s.f_command = std::min(s.f_contact, 3.3) * 0.97;
  const auto ramp = [&](double from, double to) {
    return std::clamp((t - from) / (to - from), 0.0, 1.0);
  };
  s.depth = t < 6.1 ? -0.01 + 0.01 * ramp(0, 6.1)
                    : 0.008 * ramp(6.1, 8) + 0.034 * ramp(9.5, 18.3) - 0.011 * ramp(18.6, 20) +
                          0.012 * ramp(20.5, 26.2);
  return s;
}

inline std::vector<assess::Penalty> penaltiesWithTrouble() {
  return {{"COL_LUNG",
           "Lung touched",
           "The needle was in the lung for 0.35 s, first at 18.3 s.",
           7,
           500,
           3500,
           {18.3},
           "samples"},
          {"COL_RIB",
           "Ribs or skeleton touched",
           "No bone was touched harder than the guiding contact with the clavicle.",
           0,
           50,
           0,
           {},
           "contacts"},
          {"COL_ART", "Artery touched", "The artery was not touched.", 0, 50, 0, {}, "samples"},
          {"COL_VEIN",
           "Vein touched needlessly",
           "The needle touched the vein's wall for 0.15 s before it entered.",
           3,
           10,
           30,
           {24.9, 25.6},
           "samples"},
          {"PHASE_1",
           "Entry point",
           "The skin was punctured 3.1 mm from the optimum; the needle was turned 1.1 mm too deep.",
           4.2,
           2,
           8.4,
           {6.1},
           "mm"},
          {"PHASE_2",
           "Direction",
           "The needle pointed 7.1° away from the optimum, 1.18 times what experts vary by.",
           1180,
           0.2,
           236,
           {9}},
          {"ECON_MEAN",
           "Path",
           "On average the needle was 3.4 mm from the optimal line.",
           3.4,
           2,
           6.8,
           {},
           "mm"},
          {"ECON_VAR",
           "Steadiness",
           "The distance from the optimal line varied by 2.9 mm (one standard deviation).",
           8.31,
           20,
           166.2,
           {},
           "mm²"},
          {"TIME", "Time", "The trial took 31.5 s.", 31524, 0.01, 315.24, {}, "ms"}};
}

inline assess::TrialAssessment trialWithTrouble() {
  assess::TrialAssessment a;
  a.trial = 1;
  a.role = training::Role::scored;
  a.simulated = true;
  a.seed = 20240517;
  a.outcome = training::Outcome::success;
  a.summary =
      "The vein was reached and blood aspirated after 31.5 s. On the way the lung was touched "
      "once, for 0.3 s.";
  a.values = {7, 0, 0, 3, 4.2, 1180, 3.4, 8.31, 31524, true};
  a.penalties = penaltiesWithTrouble();
  for (const auto& p : a.penalties) a.total += p.points;
  a.spans = {{"1 insertion", assess::SpanKind::phase, 0, 9},
             {"2 advance", assess::SpanKind::phase, 9, 26.2},
             {"aspiration", assess::SpanKind::phase, 26.2, 31.5},
             {"clavicle contact", assess::SpanKind::guide, 13, 15.2},
             {"clavicle contact", assess::SpanKind::guide, 16, 16.4},
             {"in the vein", assess::SpanKind::good, 26.2, 31.5},
             {"lung", assess::SpanKind::bad, 18.3, 18.65}};
  a.moments = {{6.1, "puncture", "Skin punctured (1.6 N)"},
               {9.0, "reorient", "Needle turned"},
               {13.0, "bone", "Clavicle felt"},
               {18.3, "lung", "Lung touched"},
               {18.9, "withdraw", "Needle drawn back"},
               {24.9, "vein_wall", "Vein wall touched"},
               {26.2, "vein", "Vein entered"},
               {27.4, "flash", "Blood in the syringe"},
               {31.5, "success", "Aspirated for 1 s: success"}};
  a.closest_pleura_mm = -1.3;
  a.closest_pleura_s = 18.5;
  a.closest_artery_mm = 6.4;
  a.closest_artery_s = 27.1;
  a.skin_punctures = 1;
  a.redirections = 2;
  return a;
}

/// A later, cleaner one: number `n` of a series.
inline assess::TrialAssessment laterTrial(int n) {
  assess::TrialAssessment a = trialWithTrouble();
  a.trial = n;
  const double ease = std::exp(-0.3 * n);
  a.values = {0,
              std::floor(8 * ease),
              0,
              1,
              2 + 4 * ease,
              600 + 900 * ease,
              1.5 + 3 * ease,
              2 + 9 * ease,
              21000 + 30000 * ease,
              true};
  const auto& v = a.values;
  const double counts[] = {v.col_lung, v.col_rib,   v.col_art,  v.col_vein, v.phase_1,
                           v.phase_2,  v.econ_mean, v.econ_var, v.time_ms};
  const double weights[] = {500, 50, 50, 10, 2, v.phase_2 < 1000 ? 0 : 0.2, 2, 20, 0.01};
  a.total = 0;
  for (std::size_t i = 0; i < a.penalties.size(); ++i) {
    auto& p = a.penalties[i];
    p.value = counts[i];
    p.weight = weights[i];
    p.points = p.value * p.weight;
    p.moments_s.clear();
    a.total += p.points;
  }
  a.summary = "The vein was reached and blood aspirated.";
  std::erase_if(a.spans, [](const auto& s) { return s.kind == assess::SpanKind::bad; });
  std::erase_if(a.moments, [](const auto& m) { return m.kind == "lung" || m.kind == "withdraw"; });
  a.closest_pleura_mm = 2.1 + n;
  return a;
}

inline TrialPage pageOf(const assess::TrialAssessment& assessment) {
  TrialPage page{assessment, {}, {}};
  for (int i = 0; i <= 3150; ++i) page.samples.push_back(sampleAt(0.01 * i));
  return page;
}

inline SessionReport syntheticReport(int trials = 1) {
  SessionReport report;
  report.title = "Access to the subclavian vein, right side";
  report.trainee = "simulated novice";
  report.simulated = true;
  report.when = "17 May 2024, 10:42";
  report.trials.push_back(pageOf(trialWithTrouble()));
  for (int n = 2; n <= trials; ++n) {
    report.trials.push_back(pageOf(laterTrial(n)));
    auto& a = report.trials.back().assessment;
    if (n == 2) a.role = training::Role::familiarisation;
    if (n == 4)
      a.outcome = training::Outcome::voided,
      a.summary = "The board was covered; the trial does not count.";
    if (n == 5)
      a.outcome = training::Outcome::time, a.values.success = false,
      a.summary = "The vein was not found within 300 s.";
  }
  report.registration = {
      {"Registration error at the entry point, median", "0.4 mm", "against the bench's truth"},
      {"Registration error at the entry point, 95 %", "0.9 mm", "against the bench's truth"},
      {"Board pose, standard deviation", "0.2 mm, 0.1°", "from the covariance of the corners"}};
  report.station = {{"Haptic device", "virtual, 7.9 N, 1 kHz", ""},
                    {"Camera", "640 × 480, 15 Hz", "virtual"},
                    {"Software", "Palpa 0.1.0", ""}};
  report.taxonomy = {{"What is felt", "virtual reality", ""}};
  report.notes = {{"Ticks later than 1 ms", "0 of 31 500", ""},
                  {"Board lost from view", "0.8 s", "at 12.1 s; the last pose was kept"}};
  return report;
}

}  // namespace palpa::report::test
