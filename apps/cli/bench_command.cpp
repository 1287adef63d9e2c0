#include "apps/bench/anatomy_bench.h"
#include "apps/bench/calibration_bench.h"
#include "apps/bench/haptics_bench.h"
#include "apps/bench/loop_bench.h"
#include "apps/cli/commands.h"

namespace palpa::cli {
namespace {

void addHaptics(CLI::App& bench) {
  CLI::App* haptics = bench.add_subcommand("haptics", "Cost of the tick, fidelity and smoothness of its force");
  haptics->footer("Example:\n  palpa bench haptics > haptics.jsonl\n  palpa bench haptics --quick");
  const auto options = std::make_shared<bench::HapticsBenchOptions>();
  haptics->add_flag("--quick", options->quick, "Small meshes and short strokes");
  haptics->add_option("--most-triangles", options->most_triangles, "Leave out larger meshes")->check(CLI::Range(1000, 1'000'000));
  haptics->callback([options] { bench::benchHaptics(*options); });
}

void addLoop(CLI::App& bench) {
  CLI::App* loop = bench.add_subcommand("loop", "Lateness of the haptic loop beside a bare timer loop, under load");
  loop->footer("Example:\n  palpa bench loop > loop.jsonl\n  palpa bench loop --rate 4000 --cpu 1");
  const auto options = std::make_shared<bench::LoopBenchOptions>();
  loop->add_option("--seconds", options->seconds, "Of measurement, in 40 segments")->check(CLI::Range(1.0, 3600.0));
  loop->add_option("--rate", options->rate_Hz, "Ticks a second")->check(CLI::Range(1000.0, 4000.0));
  loop->add_option("--cpu", options->cpu, "Keep the measured thread on this processor")->check(CLI::Range(0, 1023));
  loop->callback([options] { bench::benchLoop(*options); });
}

void addAnatomy(CLI::App& bench) {
  CLI::App* anatomy = bench.add_subcommand("anatomy", "Cost of the geometric questions and of the skin's deflection, beside other libraries'");
  anatomy->footer("Example:\n  palpa bench anatomy > anatomy.jsonl\n  palpa bench anatomy --quick");
  const auto options = std::make_shared<bench::AnatomyBenchOptions>();
  anatomy->add_flag("--quick", options->quick, "A smaller mesh and few queries");
  anatomy->callback([options] { bench::benchAnatomy(*options); });
}

void addCalibration(CLI::App& bench) {
  CLI::App* calibration = bench.add_subcommand("calibration", "How near the estimators come to what the data permit (simulated data)");
  calibration->footer("Example:\n  palpa bench calibration > calibration.jsonl\n  palpa bench calibration --sets 50");
  const auto options = std::make_shared<bench::CalibrationBenchOptions>();
  calibration->add_option("--sets", options->sets, "Synthetic sets for each estimator (default 500)")->check(CLI::Range(10, 100'000));
  calibration->callback([options] { bench::benchCalibration(*options); });
}

}  // namespace

void addBench(CLI::App& program) {
  CLI::App* bench = program.add_subcommand("bench", "Measurements, one JSON object a line");
  bench->require_subcommand(1);
  addAnatomy(*bench);
  addCalibration(*bench);
  addHaptics(*bench);
  addLoop(*bench);
}

}  // namespace palpa::cli
