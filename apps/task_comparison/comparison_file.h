#pragma once

#include <array>
#include <filesystem>
#include <string>
#include <vector>

#include "apps/assess/comparison/comparison_trial.h"
#include "apps/station/material_files.h"
#include "apps/station/task_sections.h"

namespace palpa::task_comparison {

/// A comparison task as its file says it (assets/tasks/squeeze.json, friction.json).
struct ComparisonSettings {
  std::string id, title, brief;
  station::LumpLibrary library;  ///< its surface is what is squeezed or stroked
  /// Of what is squeezed: m, from the middle to a side; kg, of the real object
  double half = 0.03, mass = 0.02;
  Vec3 size = Vec3(0.1, 0.1, 0.05);  ///< m, of what is stroked, as it is shown
  /// Times the real one, to be told from it
  std::vector<double> stiffness, weight, friction;
  std::vector<double> sorted;        ///< times the real friction, of which some are put in order
  int sorts = 4;                     ///< so many
  double touch = 0.1, too_hard = 2;  ///< N
  double time_limit_s = 90;
  double sort_limit_s = 300;  ///< of a trial in which more than two are put in order
  station::Taxonomy taxonomy;
  std::string source;  ///< the file's text, for the evidence
};

/// Two devices hold something: how hard, how heavy? They throw UsageError naming file and field,
/// Error for a library that cannot be used.
ComparisonSettings readSqueeze(const std::filesystem::path& file);
/// One tool strokes over something: how rough?
ComparisonSettings readFriction(const std::filesystem::path& file);

/// Things that are felt in a trial, two or more: of what they differ, and how much each has of the
/// real thing's.
struct Comparison {
  assess::ComparedProperty property = assess::ComparedProperty::stiffness;
  std::vector<double> factors{1, 1};
};
/// So many of two things, the same for the same seed: every difference as often as every other, the
/// real thing as often first as second, in no order.
std::vector<Comparison> comparisonsOf(const ComparisonSettings& settings, std::uint64_t seed,
                                      int count);
/// So many of `settings.sorts` surfaces each, the same for the same seed: drawn from
/// `settings.sorted`, none twice in a trial, in no order.
std::vector<Comparison> sortingsOf(const ComparisonSettings& settings, std::uint64_t seed,
                                   int count);

/// A comparison as its event in the record says it, and read again. Throws Error for words that are
/// none.
std::string comparisonText(const Comparison& comparison);
Comparison comparisonIn(const std::string& text);

}  // namespace palpa::task_comparison
