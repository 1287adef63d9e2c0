#include <gtest/gtest.h>

#include <algorithm>

#include "apps/report/pulse/pulse_report.h"
#include "apps/training/trial_words.h"
#include "tests/support/files.h"
#include "well_formed.h"

namespace palpa::report {
namespace {

assess::PulseTrial examinedPulse(int trial, int delivered, int counted) {
  assess::PulseTrial t;
  t.trial = trial;
  t.role = training::Role::scored;
  t.outcome = training::Outcome::done;
  t.artery = "femoral";
  t.depth_m = 0.014;
  t.rhythm = assess::PulseRhythm::premature;
  t.said = assess::PulseRhythm::premature;
  t.off_m = 0.003;
  t.found_s = 55;
  t.delivered = delivered;
  t.counted = counted;
  t.seconds = 101;
  t.peak_N = 0.9;
  return t;
}

PulseReport somePulses() {
  PulseReport report;
  report.title = "Find the <pulse>";
  report.trainee = "T007";
  report.trials = {examinedPulse(1, 36, 36), examinedPulse(2, 40, 35), examinedPulse(3, 30, 31)};
  report.trials[2].outcome = training::Outcome::voided;
  report.trials[1].peak_N = 2.5;
  return report;
}

std::string pulsePage(const PulseReport& report) {
  const std::filesystem::path file = palpa::test::freshFolder("report", "pulse") / "report.html";
  writePulseReport(report, file);
  return palpa::test::slurp(file);
}

bool has(const std::string& text, const std::string& part) {
  return text.find(part) != std::string::npos;
}

TEST(PulsePage, SaysHowManyWereFoundCountedAndTold) {
  const std::string page = pulsePage(somePulses());
  EXPECT_TRUE(has(page,
                  "Pulses found: 2 of 2; counted within 3 beats a minute: 1 of 2; rhythms "
                  "named right: 2 of 2."));
  EXPECT_TRUE(has(page, ">70<"));
  EXPECT_TRUE(has(page, ">2.5: too hard<"));
  EXPECT_TRUE(has(page, "3 (not counted)"));
  EXPECT_TRUE(has(page, "What a good examiner does"));
  EXPECT_TRUE(has(page, "trial 2: pressed up to 2.5 N"));
  EXPECT_TRUE(has(page, "Find the &lt;pulse&gt;"));
}

TEST(PulsePage, WithoutATrialThatCountsItSaysSo) {
  PulseReport report = somePulses();
  for (assess::PulseTrial& trial : report.trials) trial.outcome = training::Outcome::voided;
  EXPECT_TRUE(has(pulsePage(report), "No trial counts"));
  report.trials.clear();
  EXPECT_TRUE(has(pulsePage(report), "No trial counts"));
}

TEST(PulseTable, HasARowForEveryTrialThatCounts) {
  const std::filesystem::path file = palpa::test::freshFolder("report", "pulse_csv") / "trials.csv";
  PulseReport report = somePulses();
  report.trials[0].off_m.reset();
  writePulseCsv("T007", report.trials, report.rules, file);
  const std::string csv = palpa::test::slurp(file);
  EXPECT_EQ(std::count(csv.begin(), csv.end(), '\n'), 3);
  EXPECT_TRUE(
      has(csv, "T007,2,0,0,1,done,femoral,14,premature,premature,0,1,3,55,40,35,-10,1,0,2.5,101"));
  EXPECT_TRUE(has(csv, "premature,premature,0,0,,55,36,36,0,1,0,0.9,101"));
}

}  // namespace
}  // namespace palpa::report
