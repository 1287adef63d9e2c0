#pragma once

#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "apps/assess/progress/standing.h"

/// What experts reach in a task, to read a learner's result by.
namespace palpa::evidence {

/// Of each task that these sessions are of, by its file's id: from the trials that count, judged
/// again. `simulated` where any session is. Throws Error for a file that is none, or damaged.
std::map<std::string, progress::Group> expertRangesIn(
    const std::vector<std::filesystem::path>& sessions);

/// "palpa expert ranges": {"tasks": {id: group}}, and the command that makes it again.
void writeExpertRanges(const std::map<std::string, progress::Group>& of_task,
                       const std::string& made_by, const std::filesystem::path& file);

/// Read again. Throws UsageError for a file that is none, or damaged.
std::map<std::string, progress::Group> readExpertRanges(const std::filesystem::path& file);

/// Of a task as shipped; none where nobody did it. Throws as readExpertRanges.
std::optional<progress::Group> shippedExperts(const std::string& task_id);

}  // namespace palpa::evidence
