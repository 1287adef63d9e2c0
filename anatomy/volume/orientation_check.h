#pragma once

#include "anatomy/volume/scan.h"

namespace palpa::anatomy {

/// A sentence with the option to give when the volume seems to lie otherwise than its header says;
/// empty otherwise. Looked at: the bone near the midline (spine) lies behind the body's middle;
/// beside it there is more bone at the shoulders' end than at the other. Either must be clear (3
/// mm; a factor of 1.6) to be said.
std::string probableFlip(const Volume& volume, const Levels& levels);

}  // namespace palpa::anatomy
