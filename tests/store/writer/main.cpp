#include <unistd.h>

#include <cstdio>
#include <cstdlib>
#include <exception>
#include <string>
#include <vector>

#include "apps/record/store/delivery.h"
#include "tests/store/trials.h"

namespace {

using namespace palpa::record;

constexpr Patience kPatient{2000, 20'000'000};

/// Waits until it may deliver: 'g' one trial, 'f' or the end of the words all that follow.
bool mayGoFreely() {
  char word = 'f';
  return ::read(STDIN_FILENO, &word, 1) != 1 || word == 'f';
}

int deliverAll(const std::string& url, const std::string& trainee, int count) {
  std::vector<StoredTrial> left;
  for (int i = count; i >= 1; --i) left.push_back(trialOf(i, i));
  while (!left.empty()) {
    std::vector<StoredTrial> now{left.back()};
    left.pop_back();
    if (mayGoFreely()) now.insert(now.end(), left.rbegin(), left.rend()), left.clear();
    deliver(url, sessionOf(trainee, "session-" + trainee), now, kPatient);
    const std::string arrived(now.size(), 'a');
    if (::write(STDOUT_FILENO, arrived.data(), arrived.size()) < 0) return 1;
  }
  return 0;
}

int addTrainee(const std::string& url, const std::string& trainee) {
  try {
    RecordStore(url).addTrainee(novice(trainee));
    return 0;
  } catch (const palpa::UsageError& e) {
    return std::string(e.what()).find("is in the records already") != std::string::npos ? 3 : 4;
  }
}

}  // namespace

/// palpa_test_writer URL TRAINEE COUNT: a station that delivers a session, trial by trial; says "a"
/// for each that has arrived. palpa_test_writer URL TRAINEE: adds the trainee; 3: is there already.
int main(int argc, char** argv) {
  try {
    if (argc == 3) return addTrainee(argv[1], argv[2]);
    return argc == 4 ? deliverAll(argv[1], argv[2], std::atoi(argv[3])) : 2;
  } catch (const std::exception& e) {
    std::fprintf(stderr, "%s\n", e.what());
    return 1;
  }
}
