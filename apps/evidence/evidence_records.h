#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "apps/assess/progress/history.h"
#include "apps/record/store/delivery.h"
#include "apps/record/store/record_store.h"

namespace palpa::evidence {

/// A session as the records of a centre keep it, made from its evidence alone.
struct EvidenceRecords {
  record::StoredSession session;
  std::vector<record::StoredTrial> trials;  ///< that ended, each with every figure, judged again
  /// trials in whose middle the program stopped: they stay in the evidence only
  int unfinished = 0;
};

/// Throws Error for a file that is none or damaged.
EvidenceRecords recordsOf(const std::filesystem::path& evidence);

struct EvidenceDelivery {
  std::string trainee;
  record::Delivered trials;
  int unfinished = 0;  ///< trials in whose middle the program stopped: left out
};

/// A session's trials into the records at `url`, noted on this station until the store has all of
/// them. What fails stays noted for `palpa records deliver`, but for evidence of a person who was
/// deleted. Throws Error.
EvidenceDelivery deliverEvidence(const std::filesystem::path& evidence, const std::string& url,
                                 const record::Patience& patience = {});

/// Of an address, as it stays true in another folder: files as absolute paths.
std::string absoluteRecords(const std::string& url);

/// Which trials a page is about; an empty text means any.
struct PracticeChoice {
  std::string trainee, group, task;
  std::string task_id = {};  ///< of the task's file: which of several that count as one task
  std::vector<std::string> left_out = {};  ///< ids of studies
  bool without_studies = false;            ///< leaves all of them out
  int simulated = -1;                      ///< 0, 1; -1: any
};
/// What makes a trial unlike others of its task.
struct PracticeCondition {
  std::string mode;   ///< a search's stiffness, what a comparison asks; empty: the usual
  std::string rules;  ///< of scoring
  bool cues_on = false, guided = false;
};
/// In the words of PracticeTrial's: "augmented, cues on"; empty: nothing does.
std::string conditionOf(const PracticeCondition& of);
/// Trials as the pages of practice take them, by trainee, arrival and number. Throws Error for a
/// session whose description is damaged.
std::vector<progress::PracticeTrial> practiceIn(record::RecordStore& store,
                                                const PracticeChoice& choice);

}  // namespace palpa::evidence
