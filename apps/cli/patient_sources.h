#pragma once

#include <memory>
#include <string>

#include <CLI/CLI.hpp>

#include "anatomy/parametric/phantoms.h"
#include "anatomy/patient.h"

namespace palpa::cli {

/// Options of `patient build` for a patient from a CT volume.
struct CtArguments {
  std::string ct, axes, series, seeds, previews;
  std::vector<std::string> points;
  double bone = 0, dense = 0;
  bool mirrored = false;
  const CLI::Option* bone_given = nullptr;
  const CLI::Option* dense_given = nullptr;
};

std::shared_ptr<CtArguments> addCtOptions(CLI::App& command);

/// Reads, segments, says what was found and what is not known, writes previews and seeds. `side`:
/// empty for the side of the contrast.
anatomy::Patient buildFromCt(const CtArguments& arguments, const std::string& side);

/// `--phantom breast|abdomen` with what it hides, beside the options that describe a person.
struct PhantomOptions {
  std::string kind;         ///< empty: a person is to be built
  double inclusion_mm = 0;  ///< 0: none
  double depth_mm = 15, left_mm = 0, up_mm = 0;
};

void addPhantomOptions(CLI::App& command, PhantomOptions* options);
anatomy::Patient buildPhantom(const PhantomOptions& options);

}  // namespace palpa::cli
