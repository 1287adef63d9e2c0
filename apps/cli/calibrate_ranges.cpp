#include <cstdio>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "anatomy/base/counted.h"
#include "apps/cli/commands.h"
#include "apps/cli/values.h"
#include "apps/evidence/expert_ranges.h"

namespace palpa::cli {
namespace {

constexpr const char* kRangeExamples = R"(Examples:
  palpa calibrate ranges --from out/expert-a/session.palpa out/expert-b/session.palpa
      what these experts reached, beside which a learner's report shows the learner
A task that is shipped finds its experts in assets/tasks/expert_ranges.json;
assets/tasks/expert_ranges.sh makes that file again, of simulated experts.)";

struct RangeOptions {
  std::vector<std::string> from;
  std::string out = "expert_ranges.json", made_by = "palpa calibrate ranges --from ...";
};

void calibrateRanges(const RangeOptions& o) {
  const auto ranges = evidence::expertRangesIn({o.from.begin(), o.from.end()});
  for (const auto& [task, group] : ranges)
    std::printf("%s: %s of %s%s\n", task.c_str(), counted(group.trials, "trial").c_str(),
                counted(group.people, "expert").c_str(), group.simulated ? " (simulated)" : "");
  evidence::writeExpertRanges(ranges, o.made_by, o.out);
  std::printf("Written: %s\n", o.out.c_str());
}

}  // namespace

void addExpertRanges(CLI::App& calibrate) {
  CLI::App* ranges = calibrate.add_subcommand(
      "ranges", "What experts reach, from their recorded sessions: shown beside learners' results");
  ranges->footer(kRangeExamples);
  const auto o = std::make_shared<RangeOptions>();
  ranges->add_option("--from", o->from, "Recorded sessions of experts")
      ->required()
      ->type_name("FILE...");
  ranges->add_option("--out", o->out, "File to write")->type_name("FILE");
  ranges->add_option("--made-by", o->made_by, "Noted in the file: how it is made again")
      ->type_name("TEXT");
  ranges->callback([o] { calibrateRanges(*o); });
}

}  // namespace palpa::cli
