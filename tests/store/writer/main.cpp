#include <unistd.h>

#include <cstdio>
#include <cstdlib>
#include <exception>
#include <string>

#include "apps/record/store/delivery.h"
#include "tests/store/trials.h"

namespace {

using namespace palpa::record;

constexpr Patience kPatient{2000, 20'000'000};

/// Waits until it may go on: 'g' for one trial, 'f' or the end for all that follow.
bool mayGo(bool& freely) {
  char word = 'f';
  if (!freely && ::read(STDIN_FILENO, &word, 1) == 1) freely = word == 'f';
  else freely = true;
  return true;
}

int deliverAll(const std::string& url, const std::string& trainee, int count) {
  const StoredSession session = sessionOf(trainee, "session-" + trainee);
  bool freely = false;
  for (int i = 1; i <= count && mayGo(freely); ++i) {
    deliver(url, session, {trialOf(i, i)}, kPatient);
    if (::write(STDOUT_FILENO, "a", 1) != 1) return 1;
  }
  return 0;
}

int addTrainee(const std::string& url, const std::string& trainee) {
  try {
    RecordStore(url).addTrainee(novice(trainee));
    return 0;
  } catch (const palpa::UsageError& e) {
    std::fprintf(stderr, "%s\n", e.what());
    return 3;
  }
}

}  // namespace

/// palpa_test_writer URL TRAINEE COUNT: a station that delivers a session, trial by trial; says "a" for each that has arrived.
/// palpa_test_writer URL TRAINEE: adds the trainee; 3 when that is not right.
int main(int argc, char** argv) {
  try {
    if (argc == 3) return addTrainee(argv[1], argv[2]);
    return argc == 4 ? deliverAll(argv[1], argv[2], std::atoi(argv[3])) : 2;
  } catch (const std::exception& e) {
    std::fprintf(stderr, "%s\n", e.what());
    return 1;
  }
}
