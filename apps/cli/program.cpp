#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <sstream>

#include "apps/cli/command_tree.h"
#include "apps/cli/commands.h"
#include "apps/cli/usage_words.h"

namespace palpa::cli {
namespace {

constexpr const char* kWelcome =
    R"(Palpa: visuo-haptic training for palpation and needle procedures.

Nothing is connected? Everything runs on the virtual bench. What you can do now:

  palpa console                            the educator's pages in a browser: everything below by mouse
                                           (palpa alone opens them where there is a display)
  palpa subclavian                         a session: with a display you hold the needle with the mouse,
                                           without one a simulated expert performs it
  palpa subclavian --operator novice       watch a simulated novice; read the report's reasons
  palpa subclavian --trials 10 --fast      ten trials, as fast as this computer can
  palpa palpation --operator expert --fast search a soft phantom for virtual lumps that can be felt
  palpa search --operator expert --fast    find the rough one of three things on a floor that is felt, not seen
  palpa replay out/.../session.palpa       run a recorded session again: same forces, same score
  palpa patient info                       what the patient contains
  palpa calibrate all                      set the station up; a page says whether it is ready
  palpa doctor                             is the station ready? what to do if it is not
  palpa board print --out board.png        the board that the camera looks for

A session leaves its results in out/<command>-<time>/: open report.html first.
`palpa <command> --help` explains a command with examples.
)";

/// Help, or the version: on the terminal as everything else.
int answerOf(const CLI::App& program, const CLI::ParseError& asked) {
  std::ostringstream text;
  const int code = program.exit(asked, text, text);
  std::fputs(text.str().c_str(), stdout);
  return code;
}

}  // namespace

void addCommands(CLI::App& program) {
  program.name("palpa");
  program.description("Visuo-haptic augmented reality for medical training");
  program.formatter(plainHelp());  // before the commands: they take it over
  program.set_version_flag("--version", "palpa " PALPA_VERSION);
  program.add_flag("--verbose")
      ->description("Anywhere: when something fails, tell as well what a library said of it");
  program.add_option("--language")
      ->type_name("CODE")
      ->description(
          "Anywhere: the language of window, pages and terminal, such as el "
          "(default: as LANG says; files for programs are always written the same)");
  program.footer(
      "Examples:\n  palpa subclavian --operator expert --seed 1 --fast --out A\n"
      "  palpa subclavian --help");
  program.require_subcommand(0, 1);
  program.parse_complete_callback([&program] { refuseLackingValues(program); });
  addSubclavian(program);
  addPalpation(program);
  addSqueeze(program);
  addFriction(program);
  addPulse(program);
  addSearch(program);
  addTrain(program);
  addReplay(program);
  addFinish(program);
  addCalibrate(program);
  addPatient(program);
  addRender(program);
  addBoard(program);
  addPhantom(program);
  addExport(program);
  addRecords(program);
  addStudy(program);
  addCampaign(program);
  addReport(program);
  addRate(program);
  addDoctor(program);
  addConsole(program);
  addBench(program);
  addManual(program, kWelcome);
}

int runCommand(std::vector<std::string> words) {
  CLI::App program;
  addCommands(program);
  const bool by_old_name = !words.empty() && words.front() == kNameOfBefore;
  if (by_old_name) std::fprintf(stderr, "palpa %s is called palpa subclavian now\n", kNameOfBefore);
  std::reverse(words.begin(), words.end());  // as the library wants them
  try {
    program.parse(std::move(words));
  } catch (const CLI::ParseError& e) {
    if (e.get_exit_code() == 0) return answerOf(program, e);
    return complain(usageWords(e, program), 2);
  }
  if (!program.get_subcommands().empty()) return 0;
  std::fputs(kWelcome, stdout);
  if (std::getenv("DISPLAY")) runConsole();
  return 0;
}

}  // namespace palpa::cli
