#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "apps/study/protocol.h"
#include "apps/training/engine.h"

namespace palpa::study {

/// How virtual trainees of a group learn. Levels: 0 the figures of the one operator file, 1 those
/// of the other, what lies between on the line between them.
struct GroupLearning {
  int subjects = 10;
  double start = 0, start_sd = 0;          ///< level before the first trial; between people
  double asymptote = 1, asymptote_sd = 0;  ///< level after many trials
  double rate = 0.1, rate_sd = 0;          ///< 1/trial; rate_sd of its natural logarithm
};

/// Simulated learners, as a file describes them. Nobody's real skill.
struct Learners {
  std::string id, title, planted;                      ///< planted: the effects, in words
  training::Engine engine = training::Engine::needle;  ///< of the tasks that they can do
  std::filesystem::path from, to;                      ///< operator files: level 0 and level 1
  std::map<std::string, GroupLearning> groups;
  /// by condition: how much faster a trial in it is learned from
  std::map<std::string, double> rate_times;
};

/// Throws UsageError naming file and field; a group or condition of the protocol that is missing,
/// and one that it has not, too.
Learners readLearners(const std::filesystem::path& file, const Protocol& protocol);

/// One virtual trainee. The level before a trial is
///   L = A - (A - s) exp(-r e),   e = sum over the trials before it of rate_times(condition),
/// with s, A, ln r drawn for the person from the group's means and spreads, L kept within 0 to 1:
/// an exponential learning curve (Heathcote, Brown and Mewhort 2000).
class VirtualTrainee {
 public:
  VirtualTrainee(const Learners& learners, const std::string& group, std::uint64_t seed);
  double level() const;
  void practised(const std::string& condition);  ///< a trial in it was done

 private:
  const Learners& learners_;
  double start_, asymptote_, rate_;
  double practice_ = 0;  ///< e
};

}  // namespace palpa::study
