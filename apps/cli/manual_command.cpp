#include <cstdio>

#include "apps/cli/commands.h"
#include "apps/cli/manual_page.h"

namespace palpa::cli {

void addManual(CLI::App& program, const std::string& welcome) {
  CLI::App* command =
      program
          .add_subcommand(
              "manual",
              "The manual page palpa(1) in roff, on standard output: palpa manual | man -l -")
          ->group("");
  const auto completion = std::make_shared<bool>(false);
  command->add_flag("--completion", *completion, "Instead: a completion for bash");
  command->footer("Examples:\n  palpa manual | man -l -\n  source <(palpa manual --completion)");
  command->callback([&program, welcome, completion] {
    const CommandText text = describe(program);
    std::fputs(
        (*completion ? bashCompletion(text) : manualPage(text, "palpa " PALPA_VERSION, welcome))
            .c_str(),
        stdout);
  });
}

}  // namespace palpa::cli
