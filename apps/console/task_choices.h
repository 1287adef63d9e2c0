#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include <nlohmann/json.hpp>

#include "apps/console/sessions.h"
#include "apps/training/engine.h"

/// The tasks that can be held from here, and what an educator may choose of each.
namespace palpa::console {

struct TaskChoice {
  std::string id, title;
  std::string brief;  ///< what the trainee is to do, a sentence
  training::Engine engine;
  std::filesystem::path file;
  bool curved = false;     ///< the top of its phantom
  bool block = false;      ///< is punctured, no patient
  bool real_lump = false;  ///< a lump that lies in the phantom is felt or taken away
};

/// Those that are shipped, the needle's first, the others by their ids.
std::vector<TaskChoice> taskChoices();
/// Throws UsageError where there is none of that id.
TaskChoice taskChoice(const std::string& id);

/// Whether a person can hold its tool with a mouse, on the virtual bench.
bool takesMouse(const TaskChoice& task);
/// As the page of a new session takes it.
nlohmann::json described(const TaskChoice& task);
/// The command that holds it, and what was chosen; a choice that the task does not offer is left
/// out. Throws UsageError for a surface that is not there.
std::vector<std::string> argumentsOf(const TaskChoice& task, const SessionWish& wish);

}  // namespace palpa::console
