#pragma once

#include <string>

#include "apps/bench/contact_study.h"
#include "apps/twin/phantom/phantom_file.h"

namespace palpa::bench {

/// A lump rendered over the plain phantom, against the phantom that has it: one round tool, fresh motions above the lump and beside it.
struct LumpFigures {
  double error = 0;               ///< rms of the combined force's error over rms of the combined force
  double unrendered = 0;          ///< the same with nothing rendered
  double position_mm = 0;         ///< largest error of where the lump is
  int iterations = 0;             ///< most of the solver
};
LumpFigures lumpFigures(const twin::Phantom& plain, const twin::Phantom& lumped, const KnownPhantom& known, Noise noise);

}  // namespace palpa::bench
