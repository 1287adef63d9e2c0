#include <cstdlib>
#include <exception>
#include <opencv2/core.hpp>
#include <opencv2/core/utils/logger.hpp>
#include <string>
#include <vector>

#include "apps/bench/room/room_parts.h"
#include "apps/cli/commands.h"
#include "apps/cli/spoken_output.h"
#include "apps/cli/usage_words.h"
#include "apps/os/signals.h"
#include "apps/session/force_guard.h"
#include "apps/sound/loudspeaker.h"

namespace {

bool verbose = false;

/// Takes every --verbose away; true where there was one.
bool takeVerbose(std::vector<std::string>* words) { return std::erase(*words, "--verbose") > 0; }

int tellFailure() {
  const palpa::cli::FailureWords words =
      palpa::cli::failureWords(std::current_exception(), verbose);
  return palpa::cli::complain(words.text, words.exit_code);
}

/// What is thrown on a thread that nobody waits for.
[[noreturn]] void endWithWords() {
  std::_Exit(std::current_exception()
                 ? tellFailure()
                 : palpa::cli::complain(
                       "something failed that was not foreseen, and the program had to stop", 1));
}

/// What went wrong is told once, in our words.
void quietLibraries() {
  cv::utils::logging::setLogLevel(cv::utils::logging::LOG_LEVEL_SILENT);
  palpa::sound::keepSoundLibrariesQuiet();
  setenv("OPENCV_FFMPEG_LOGLEVEL", "-8", 0);  // the same of what reads films: AV_LOG_QUIET
}

}  // namespace

int main(int argc, char** argv) {
  std::set_terminate(endWithWords);
  try {
    std::vector<std::string> words(argv + 1, argv + argc);
    verbose = takeVerbose(&words);
    const std::string language = palpa::cli::takeLanguage(&words);
    palpa::os::letLargeFilesFail();
    cv::setNumThreads(1);  // results must not depend on the number of cores
    if (!verbose) quietLibraries();
    if (palpa::session::isGuard(words)) return palpa::session::standGuard(words);
    if (palpa::bench::isRoomPart(words)) {
      palpa::bench::beRoomPart(words);
      return 0;
    }
    palpa::cli::speakTo(words, language);
    return palpa::cli::runCommand(std::move(words));
  } catch (...) {
    return tellFailure();
  }
}
