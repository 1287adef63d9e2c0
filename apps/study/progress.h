#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "apps/record/store/record_store.h"
#include "apps/study/protocol.h"
#include "apps/training/trial_words.h"

namespace palpa::study {

/// A trial of a study that ended, as its records have it.
struct DoneTrial {
  std::int64_t step = 0;
  std::string session;    ///< UUID
  std::string began_utc;  ///< of its session, by the station's clock
  double ended_s = 0;     ///< after that
  std::string outcome;    ///< as it is recorded
  /// A void one does not.
  bool counts() const { return !training::isVoid(outcome); }
};
DoneTrial doneTrial(const record::StoredSession& session, const record::StoredTrial& trial);

/// What a trainee is to do.
enum class NextKind { trials, questionnaire, finished };

/// What an enrolled trainee does next.
struct Next {
  NextKind kind = NextKind::finished;
  int session = 1;                      ///< of the protocol, 1, 2, ...
  std::int64_t step = 0;                ///< trials: of which block
  std::string condition;                ///< by name
  int done = 0;                         ///< of the block
  int trials = 0;                       ///< of the block, until the next rest or its end
  int left = 0;                         ///< of the block
  double rest_s = 0;                    ///< still due before them
  std::string not_before;               ///< a date; empty: now
  std::vector<std::string> open_items;  ///< questionnaire: still to be answered
  std::vector<std::string> remarks;     ///< about clocks, in words
};

/// The first block with trials missing, the first questionnaire with items missing, in the
/// protocol's order; `trials` in the order of their arrival, void ones not counting; `answered`:
/// (session, item). Order is that of arrival, whatever clocks said: a session dated before the one
/// that came before it is told. A rest is due after `rest_after` trials and after each block with
/// one; days are UTC dates.
Next nextOf(const Protocol& protocol, const std::string& drawn,
            const std::vector<DoneTrial>& trials,
            const std::vector<std::pair<int, std::string>>& answered, const std::string& now_utc);

/// In words, without the condition: "session 1 of 2, learning: 3 of 10 trials".
std::string whereIs(const Protocol& protocol, const Next& next);

}  // namespace palpa::study
