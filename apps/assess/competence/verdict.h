#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "apps/assess/competence/form.h"
#include "apps/assess/statistics/cusum.h"
#include "apps/training/trial_words.h"

namespace palpa::competence {

/// A figure of the trial by name: not a number where it does not apply; nothing where it was not
/// kept (an older record).
using Figures = std::function<std::optional<double>(const std::string& metric)>;

enum class Mark { done, not_done, did_not_arise, open };  ///< open: nobody has judged it

const char* markWords(Mark mark);  ///< "done", "not done", "did not arise", "not judged"

struct MarkedItem {
  const ChecklistItem* item = nullptr;  ///< of the checklist that was given
  Mark mark = Mark::open;
  std::string why;  ///< "28 % (at least 50 %)"; empty: a rater's word, or nobody's
};

/// Share of items done. Items that did not arise are left out; open ones make the share uncertain:
/// `low` takes them as not done, `high` as done.
struct ChecklistScore {
  int done = 0, not_done = 0, did_not_arise = 0, open = 0;
  int major_done = 0,
      minor_done = 0;        ///< those that did not arise among them: nothing was left out
  int major = 0, minor = 0;  ///< of all items
  double low = 0, high = 0;
};

/// Marks by the simulator where there are rules, else by the rater.
std::vector<MarkedItem> marked(const Checklist& checklist, const Figures& figures,
                               const Answers& rater);
ChecklistScore scoreOf(const std::vector<MarkedItem>& items);

/// "competent", "borderline", "below borderline"; open items count as not done.
const char* levelOf(const ChecklistScore& score, const Checklist& checklist);

enum class Status { passed, failed, not_certified };

struct Verdict {
  Status status = Status::not_certified;
  std::vector<std::string> reasons;   ///< sentences; why it failed, or what is missing
  std::vector<std::string> critical;  ///< what happened of the critical errors
  std::vector<MarkedItem> items;
  ChecklistScore score;
  std::string level;
  double standard = 0;                ///< share that was asked for
  std::optional<double> global_mean;  ///< of the rater's grades
};

struct VerdictFacts {
  bool assessed = false;                                ///< every aid was off
  training::Outcome outcome = training::Outcome::none;  ///< of the trial; void ones are not judged
};

/// Pass = checklist at the standard AND global rating at its cut-off AND no critical error (11 of
/// 34 trainees passed two checklists, failed the global rating and made serious errors: PMID
/// 21877217). What fails for certain fails whether or not a rater was there; what lacks a rater, or
/// was practice with aids at hand, is not certified. `checklist` must outlive the verdict.
Verdict judge(const VerdictFacts& facts, const Checklist& checklist, const Figures& figures,
              const Answers& checklist_answers, const GlobalRating* global,
              const Answers& global_answers, double standard);

/// "Pass", "Fail", "Not certified".
const char* statusWords(Status status);

/// How many trials it takes to certify somebody by the sequential test, at rates of failure that an
/// educator may choose; none is established for this procedure.
struct Certification {
  statistics::CusumRates rates;
  statistics::CusumLimits limits;
};

/// 10/25, 10/20, 5/15 and 5/10 % with chances of error of 0.1.
std::vector<Certification> certifications();

/// What `trials` trials cannot certify, in a sentence: "1 trial cannot certify anybody: ... at
/// least 13 trials in a row without a failure ...".
std::string whatCannotBeCertified(int trials);

}  // namespace palpa::competence
