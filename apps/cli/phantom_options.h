#pragma once

#include <CLI/CLI.hpp>
#include <string>

#include "anatomy/phantoms.h"

namespace palpa::cli {

/// `--phantom breast|abdomen` with what it hides, beside the options that describe a person.
struct PhantomOptions {
  std::string kind;         ///< empty: a person is to be built
  double inclusion_mm = 0;  ///< 0: none
  double depth_mm = 15, left_mm = 0, up_mm = 0;
};

void addPhantomOptions(CLI::App& command, PhantomOptions* options);
anatomy::Patient buildPhantom(const PhantomOptions& options);

}  // namespace palpa::cli
