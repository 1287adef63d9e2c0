#pragma once

#include <string>
#include <vector>

#include "apps/record/store/record_store.h"
#include "apps/session/session_options.h"
#include "apps/study/analysis/study_design.h"

namespace palpa::study {

/// What `palpa study run` and `status` understand.
struct StudyOptions {
  std::string protocol, url;
  std::string trainee;    ///< empty: nobody was named
  std::string answers;    ///< file with the questionnaire's answers; empty: they are asked for
  bool simulate = false;  ///< virtual trainees in place of one
  int subjects = 0;       ///< of each group; 0: as the learners' file says
  std::string learners;
  int workers = 2;                  ///< processes
  std::uint64_t seed = 0;           ///< of the study, where it begins; 0: drawn
  session::SessionOptions session;  ///< where and how sessions are held
};

/// Leads one trainee through the next session of a protocol: blocks, rests, questionnaire; begins
/// where he left off. Throws UsageError or Error.
void runStudySession(const StudyOptions& options);

/// Fills a protocol with virtual trainees who learn. Throws UsageError or Error.
void simulateStudy(const StudyOptions& options);

/// Who is enrolled, who is next, how far everybody is; nothing that tells a condition before it is
/// used, nor where the protocol is blind. Throws Error.
void reportStudy(const StudyOptions& options);

/// Scored trials of a study as its records tell them: group, condition and block from what each
/// session says of the study; sessions in the order of their arrival. Familiarisation, void trials
/// and those without figures are left out. Throws UsageError for a study without trials, Error for
/// a session whose description is damaged or does not name the study.
std::vector<study_analysis::StudyRow> studyRows(record::RecordStore& store,
                                                const std::string& study);

/// Rows of a table in a file (study_row.h).
std::vector<study_analysis::StudyRow> studyRowsOfFile(const std::string& csv);

/// What an analysis takes from a protocol's file: the study's id, title, kind of analysis, groups
/// and conditions with their meaning.
struct ProtocolFacts {
  std::string id;
  study_analysis::StudyDesign design;
};

/// Throws UsageError naming file and field.
ProtocolFacts protocolFacts(const std::string& file);

}  // namespace palpa::study
