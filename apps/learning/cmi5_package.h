#pragma once

#include <string>
#include <vector>

namespace palpa::learning {

/// A task that can be launched.
struct CourseTask {
  std::string id, title, about;
};

/// The course structure of a station (cmi5, section 13): one assignable unit for each task,
/// launched at `address` (ending in "/") + "learning/cmi5/ID". A trainee passes whose trials are
/// all at the task's own standard (mastery score 1); the platform may ask for less.
std::string courseStructure(const std::vector<CourseTask>& tasks, const std::string& address);

/// A course package (section 14): cmi5.xml alone in a ZIP archive; what is launched stays here.
std::string coursePackage(const std::string& structure);

}  // namespace palpa::learning
