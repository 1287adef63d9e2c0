#pragma once

#include "haptics/surface/gabor_table.h"
#include "haptics/surface/search_surface.h"
#include "haptics/surface/valley_map.h"

namespace palpa::haptics {

/// A floor to be searched, with what its augmentations need to know of it; all of it fixed while a
/// tick may look at it.
struct Floor {
  const SearchSurface* surface = nullptr;
  const GaborTable* rises = nullptr;   ///< null: nothing rises
  const ValleyMap* valleys = nullptr;  ///< null: nothing attracts
};

}  // namespace palpa::haptics
