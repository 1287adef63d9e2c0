#include "apps/bench/haptics_bench.h"
#include "apps/cli/commands.h"

namespace palpa::cli {

void addBench(CLI::App& program) {
  CLI::App* bench = program.add_subcommand("bench", "Measurements, one JSON object a line");
  bench->require_subcommand(1);
  CLI::App* haptics = bench->add_subcommand("haptics", "Cost of the tick, fidelity and smoothness of its force");
  haptics->footer("Example:\n  palpa bench haptics > haptics.jsonl\n  palpa bench haptics --quick");
  const auto options = std::make_shared<bench::HapticsBenchOptions>();
  haptics->add_flag("--quick", options->quick, "Small meshes and short strokes");
  haptics->add_option("--most-triangles", options->most_triangles, "Leave out larger meshes")->check(CLI::Range(1000, 1'000'000));
  haptics->callback([options] { bench::benchHaptics(*options); });
}

}  // namespace palpa::cli
