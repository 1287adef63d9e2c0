#include <cstdio>
#include <filesystem>
#include <memory>
#include <string>

#include "anatomy/base/error.h"
#include "apps/cli/commands.h"
#include "apps/session/finish_session.h"

namespace palpa::cli {
namespace {

constexpr const char* kFinishExamples = R"(Examples:
  palpa finish
      which sessions ended before their report: killed, or the computer stopped
  palpa finish out/paracentesis-20260301-120000
      makes the report and the table of one from its evidence, and brings its trials into the records noted for it
  palpa finish out/A/session.palpa --again
      makes both again, where they are there already
Trials that were finished are judged as the session would have; one that was not is named, and not scored.)";

void listUnfinished() {
  const auto left = session::unfinishedSessions();
  if (left.empty()) std::printf("Every session noted here was finished\n");
  for (const std::filesystem::path& folder : left) std::printf("palpa finish %s\n", folder.c_str());
}

}  // namespace

void addFinish(CLI::App& program) {
  CLI::App* command = program.add_subcommand(
      "finish", "Report and table of a session whose program ended before it wrote them");
  command->footer(kFinishExamples);
  const auto given = std::make_shared<std::string>();
  const auto again = std::make_shared<bool>(false);
  command
      ->add_option("session", *given,
                   "A session's folder, or its session.palpa; without it, which there are")
      ->type_name("FOLDER");
  command->add_flag(
      "--again", *again,
      "Make both again, where they are there, without what only the running program knew");
  command->callback([given, again] {
    if (given->empty() && *again)
      throw UsageError("needs the folder of a session", "--again", "Say which one");
    if (given->empty()) return listUnfinished();
    session::finishSession(*given, *again ? session::FinishAgain::yes : session::FinishAgain::no);
  });
}

}  // namespace palpa::cli
