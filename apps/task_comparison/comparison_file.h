#pragma once

#include <array>
#include <filesystem>
#include <string>
#include <vector>

#include "apps/assess/comparison/comparison_trial.h"
#include "apps/station/material_files.h"
#include "apps/station/task_sections.h"

namespace palpa::task_comparison {

/// A comparison task as its file says it (assets/tasks/squeeze.json).
struct ComparisonSettings {
  std::string id, title;
  station::LumpLibrary library;           ///< its surface is what the object's sides are made of
  double half = 0.03, mass = 0.02;        ///< m, from the middle to a side; kg, of the real object
  std::vector<double> stiffness, weight;  ///< times the real one, to be told from it
  double touch = 0.1, too_hard = 2;       ///< N
  double time_limit_s = 90;
  station::Taxonomy taxonomy;
  std::string source;  ///< the file's text, for the evidence
};

/// Throws UsageError naming file and field, Error for a library that cannot be used.
ComparisonSettings readSqueeze(const std::filesystem::path& file);

/// Two things that are felt in a trial: of what they differ, and by how much of the real thing's.
struct Comparison {
  assess::ComparedProperty property = assess::ComparedProperty::stiffness;
  std::array<double, 2> factors{1, 1};
};
/// So many, the same for the same seed: every difference as often as every other, the real thing as
/// often first as second, in no order.
std::vector<Comparison> comparisonsOf(const ComparisonSettings& settings, std::uint64_t seed,
                                             int count);

/// A comparison as its event in the record says it, and read again. Throws Error for words that are
/// none.
std::string comparisonText(const Comparison& comparison);
Comparison comparisonIn(const std::string& text);

}  // namespace palpa::task_comparison
