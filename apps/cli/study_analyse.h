#pragma once

#include <CLI/CLI.hpp>

namespace palpa::cli {

/// `palpa study analyse`: tables, figures and a page of a study from its records.
void addStudyAnalyse(CLI::App& study);

/// `palpa study plan`: what a study of some size would find, from the learning model alone.
void addStudyPlan(CLI::App& study);

}  // namespace palpa::cli
