#pragma once

#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include <nlohmann/json_fwd.hpp>

#include "apps/assess/progress/standing.h"
#include "apps/record/session_file.h"
#include "apps/record/store/delivery.h"
#include "apps/session/session_options.h"

/// What a session owes to the records of a centre, where `options.records` names some; without,
/// nobody is recorded.
namespace palpa::session {

/// Before anything starts: the trainee must be in the records, and who is filmed a trainee
/// (UsageError). Records that cannot be
/// reached now are named in one line and do not stop a session. The usual T000 who is not in the
/// records is nobody: `options.records` is emptied, with a word.
void checkTrainee(SessionOptions& options);

/// Whom the report shows beside, into `options.others`: experts of the task (its text as the
/// evidence has it), where they did it so, too; and, where the records hold enough of them, others
/// who train in it as this session does, with the same forces and aids, in no study; `simulated`:
/// like these, by person or station. What cannot be read now is left out, with a word. Before
/// anything is opened: it may take seconds.
void meetOthers(SessionOptions& options, bool simulated, const std::string& task_json);
/// Read again from a session's evidence: as they were when it began.
std::vector<progress::Group> othersBeside(const record::SessionInfo& info);

/// With the evidence made and before its first trial, so that a killed session is delivered later;
/// held as long as the session goes on. Null: nobody is recorded.
std::unique_ptr<record::PendingHold> noteForRecords(const SessionOptions& options,
                                                    const std::string& uuid,
                                                    const std::filesystem::path& evidence);

/// After the session: one line says what arrived, or what is sent later. Throws nothing: a session
/// that was made is done.
void deliverSession(const SessionOptions& options, const std::filesystem::path& folder);

}  // namespace palpa::session
