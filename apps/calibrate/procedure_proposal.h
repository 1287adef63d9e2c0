#pragma once

#include <filesystem>
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "apps/calibrate/procedure_learning.h"

/// Parts proposed for recorded tasks by a library of interactive procedures, each with the cue that
/// the library maps to it, beside what the tasks' labels say.
namespace palpa::calibrate {

/// A stretch of a trial in which one procedure was recognised.
struct ProposedPart {
  int procedure = 0;            ///< as the library counts them
  double from_s = 0, to_s = 0;  ///< of the sequence
};
std::vector<ProposedPart> partsOf(const std::vector<int>& matched);

struct ProposedSequence {
  std::string trial;  ///< "R1, trial 3"
  std::string task;
  double begins_s = 0;  ///< of session time
  std::vector<int> matched, labelled;
  std::vector<ProposedPart> parts;
};

/// Of all recordings, or of those of one task.
struct TaskAgreement {
  std::string task;
  int recordings = 0;
  ProcedureAgreement agreement;
};

/// How much of one procedure was recognised.
struct ProcedureShare {
  double share = 0;  ///< of all time
  int visits = 0;
  double median_s = 0;  ///< of a visit
};

struct ProcedureProposal {
  calibration::ProcedureLibrary library;
  std::vector<ProposedSequence> sequences;
  std::vector<ProcedureShare> shares;  ///< as the library counts them
  ProcedureAgreement agreement;        ///< of all steps together
  std::vector<TaskAgreement> tasks;    ///< in order of their first recording
  bool simulated = false;
};

/// Each file by itself, of whatever task.
std::vector<SubtaskRecordings> readRecordingsOfTasks(
    const std::vector<std::filesystem::path>& files);

/// Same recordings, same answer. Throws Error where there is no sequence.
ProcedureProposal propose(const calibration::ProcedureLibrary& library,
                          const std::vector<SubtaskRecordings>& recordings);

/// What is proposed, and how it agrees, in plain sentences.
std::vector<std::string> wordsOf(const ProcedureProposal& proposal);

/// "kappa 0.71"; "96 % alike" where all labels mean one procedure, by which kappa says nothing;
/// "not judged".
std::string agreementInShort(const ProcedureAgreement& agreement);

/// Procedures with cues, the parts of each trial with their times, agreement.
nlohmann::ordered_json toJson(const ProcedureProposal& proposal);

/// One self-contained page for an educator. Written whole. Throws Error.
void writeProcedurePage(const ProcedureProposal& proposal, const std::string& made_by,
                        const std::string& date, const std::filesystem::path& file);

}  // namespace palpa::calibrate
