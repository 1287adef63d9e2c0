#pragma once

#include <cstddef>
#include <functional>
#include <string>
#include <vector>

#include "apps/assess/progress/standing.h"
#include "apps/report/page/html.h"
#include "apps/report/page/page_parts.h"
#include "apps/training/engine.h"

namespace palpa::report {

/// What somebody noted while the session ran.
struct Remark {
  int trial = 0;   ///< 0: between trials
  double t_s = 0;  ///< since the trial began
  std::string text;
};

/// What the page of a session says besides its trials, whatever the task is.
struct SessionPage {
  std::string title;       ///< "Palpation of the breast"
  std::string trainee;     ///< pseudonym, "simulated expert", ...
  std::string when;        ///< "30 November 2026, 09:14"; empty in virtual time
  bool simulated = false;  ///< operator or bench are simulated: said on top
  std::vector<Remark> remarks;
  /// How these trials stand beside others: of whom and, by the engine's figures, what.
  training::Engine engine = training::Engine::needle;
  std::vector<progress::JudgedTrial> judged;
  std::vector<progress::Group> others;
  std::vector<std::string> next;  ///< what to practise next, in words that follow "Practise next:"
  std::vector<Fact> taxonomy;     ///< "Where this task stands"
  std::vector<Fact> station;      ///< device, camera, display, rates
  std::vector<Fact> notes;        ///< lateness, lost tracking, safety trips
};

/// Any of `trials` says that it was simulated, or the page does.
template <class Trials, class Of>
bool isSimulated(const SessionPage& page, const Trials& trials, Of of) {
  if (page.simulated) return true;
  for (const auto& trial : trials)
    if (of(trial)) return true;
  return false;
}

/// Title, who, when, how many trials; "SIMULATED" where it was; what was noted. `more`: what else a
/// task says on top.
void writeSessionHeader(
    Html& html, const SessionPage& page, std::size_t trials, bool simulated,
    const std::function<void()>& more = [] {});

/// How it was done, folded: who reads a page that was mailed looks at its trials first. `more`: of
/// a task's own, before the station's; `terms` explains words, below all.
void writeSessionEnd(
    Html& html, const SessionPage& page, const std::function<void()>& more = [] {},
    const std::function<void()>& terms = nullptr);

}  // namespace palpa::report
