#pragma once

#include <functional>
#include <string>
#include <vector>

#include <nlohmann/json_fwd.hpp>

#include "apps/record/session_file.h"

/// What the export says of a tick beyond its record, and the laws behind it: for this folder only.
namespace palpa::record {

/// A number that reads back to the same bits, in any locale.
std::string shortest(double value);

/// As a task's file names and explains a part or an augmentation of it.
struct NamedForExport {
  std::string name, means;
};
struct TaskNames {
  std::vector<NamedForExport> parts, cues;  ///< as many as the session's plan has
};
TaskNames namesIn(const SessionInfo& info);

struct ForceColumn {
  TickColumn description;
  std::function<std::string(const haptics::FlightRecord&, const haptics::TickForces&)> value;
};
/// Of those forces that the session's kind of contact can have, and of what they follow from.
std::vector<ForceColumn> forceColumns(const SessionInfo& info);

/// Which columns add up to which: {"f_contact_D": ["f_body_D"], ...}; see haptics::TickForces.
nlohmann::json addsUp(const SessionInfo& info);

/// The name of an augmentation's force, without axis and unit.
std::string cueColumn(std::size_t i);

/// Limits, parts, augmentations; of a search the floor.
nlohmann::json cueLaws(const SessionReader& reader);

}  // namespace palpa::record
