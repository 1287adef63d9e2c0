#pragma once

#include <vector>

#include "apps/assess/search/search_trial.h"
#include "apps/training/trial_words.h"

namespace palpa::assess::test {

inline SearchTrial episode(SearchMode mode, int target, int chosen, double seconds = 20) {
  SearchTrial trial;
  trial.role = training::Role::scored;
  trial.outcome = chosen < 0 ? training::Outcome::time : training::Outcome::done;
  trial.mode = mode;
  trial.target = target;
  trial.chosen = chosen;
  trial.seconds = seconds;
  return trial;
}

/// `found` of `of` episodes with that result.
inline std::vector<SearchTrial> episodes(SearchMode mode, int found, int of) {
  std::vector<SearchTrial> trials;
  for (int i = 0; i < of; ++i)
    trials.push_back(episode(mode, i % 3, i < found ? i % 3 : (i + 1) % 3));
  return trials;
}

inline std::vector<SearchTrial> operator+(std::vector<SearchTrial> a,
                                          const std::vector<SearchTrial>& b) {
  a.insert(a.end(), b.begin(), b.end());
  return a;
}

}  // namespace palpa::assess::test
