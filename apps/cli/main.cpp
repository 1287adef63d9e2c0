#include <cstdio>
#include <cstdlib>
#include <exception>
#include <opencv2/core.hpp>
#include <opencv2/core/utils/logger.hpp>
#include <string>

#include "anatomy/base/error.h"
#include "apps/cli/commands.h"

namespace {

constexpr const char* kWelcome =
    R"(Palpa: visuo-haptic training for palpation and needle procedures.

Nothing is connected? Everything runs on the virtual bench. What you can do now:

  palpa console                            the educator's pages in a browser: everything below by mouse
                                           (palpa alone opens them where there is a display)
  palpa paracentesis                       a session: with a display you hold the needle with the mouse,
                                           without one a simulated expert performs it
  palpa paracentesis --operator novice     watch a simulated novice; read the report's reasons
  palpa paracentesis --trials 10 --fast    ten trials, as fast as this computer can
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

/// One line, whatever the message holds.
int complain(const std::string& message, int code) {
  std::string line = message.substr(0, message.find('\n'));
  std::fprintf(stderr, "palpa: %s\n", line.c_str());
  return code;
}

int run(int argc, char** argv) {
  CLI::App program("Visuo-haptic augmented reality for medical training", "palpa");
  program.set_version_flag("--version", "palpa " PALPA_VERSION);
  program.footer(
      "Examples:\n  palpa paracentesis --operator expert --seed 1 --fast --out A\n"
      "  palpa paracentesis --help");
  program.require_subcommand(0, 1);
  palpa::cli::addParacentesis(program);
  palpa::cli::addPalpation(program);
  palpa::cli::addSqueeze(program);
  palpa::cli::addSearch(program);
  palpa::cli::addTrain(program);
  palpa::cli::addReplay(program);
  palpa::cli::addCalibrate(program);
  palpa::cli::addPatient(program);
  palpa::cli::addRender(program);
  palpa::cli::addBoard(program);
  palpa::cli::addPhantom(program);
  palpa::cli::addExport(program);
  palpa::cli::addRecords(program);
  palpa::cli::addStudy(program);
  palpa::cli::addReport(program);
  palpa::cli::addRate(program);
  palpa::cli::addDoctor(program);
  palpa::cli::addConsole(program);
  palpa::cli::addBench(program);
  palpa::cli::addManual(program, kWelcome);
  try {
    program.parse(argc, argv);
  } catch (const CLI::ParseError& e) {
    if (e.get_exit_code() == 0) return program.exit(e);
    return complain(std::string(e.what()) + ". See `palpa --help`", 2);
  }
  if (!program.get_subcommands().empty()) return 0;
  std::fputs(kWelcome, stdout);
  if (std::getenv("DISPLAY")) palpa::cli::runConsole();
  return 0;
}

}  // namespace

int main(int argc, char** argv) {
  cv::setNumThreads(1);  // results must not depend on the number of cores
  cv::utils::logging::setLogLevel(
      cv::utils::logging::LOG_LEVEL_SILENT);  // what went wrong is told once, in our words
  setenv("OPENCV_FFMPEG_LOGLEVEL", "-8",
         0);  // the same of the library that reads films: AV_LOG_QUIET
  try {
    return run(argc, argv);
  } catch (const palpa::UsageError& e) {
    return complain(e.what(), 2);
  } catch (const std::exception& e) {
    return complain(e.what(), 1);
  }
}
