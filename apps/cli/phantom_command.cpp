#include <cstdio>
#include <memory>

#include "apps/cli/commands.h"
#include "apps/os/file_access.h"
#include "apps/station/assets.h"
#include "apps/twin/phantom/phantom_file.h"

namespace palpa::cli {
namespace {

struct SolveOptions {
  std::string file, out;
};

void solve(const SolveOptions& o) {
  const std::filesystem::path file =
      o.file.empty() ? station::assetFile("phantoms/mockups.json") : std::filesystem::path(o.file);
  const std::filesystem::path out =
      o.out.empty() ? std::filesystem::path(file).replace_extension(".tables.json")
                    : std::filesystem::path(o.out);
  const bool terminal = os::errorsGoToTerminal();
  twin::solvePhantoms(file, out, [&](const std::string& name, int done, int of) {
    if (terminal || done == of)
      std::fprintf(stderr, "%s%s: %d of %d%s", terminal ? "\r" : "", name.c_str(), done, of,
                   done == of ? "\n" : "");
  });
  std::printf("Written: %s\n", out.c_str());
}

}  // namespace

void addPhantom(CLI::App& program) {
  CLI::App* phantom = program.add_subcommand("phantom", "Simulated silicone phantoms");
  phantom->require_subcommand(1);
  phantom->footer("Example:\n  palpa phantom solve      the shipped mock-ups again");
  CLI::App* command = phantom->add_subcommand("solve",
                                              "The force that it takes to press the phantoms of a "
                                              "file, by finite elements (a few minutes each)");
  command->footer(
      "Examples:\n  palpa phantom solve                          the shipped mock-ups again\n  "
      "palpa phantom solve --file mine.json --out mine.tables.json");
  const auto o = std::make_shared<SolveOptions>();
  command->add_option("--file", o->file, "Phantoms (default: assets/phantoms/mockups.json)")
      ->type_name("FILE");
  command->add_option("--out", o->out, "Tables to write (default: beside the file, .tables.json)")
      ->type_name("FILE");
  command->callback([o] { solve(*o); });
}

}  // namespace palpa::cli
