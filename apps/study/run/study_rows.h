#pragma once

#include <string>
#include <vector>

#include "apps/record/store/record_store.h"
#include "apps/study/analysis/study_design.h"

namespace palpa::study {

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
