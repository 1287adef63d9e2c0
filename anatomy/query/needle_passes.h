#pragma once

#include <span>

#include "anatomy/query/surface_query.h"
#include "anatomy/query/triangle_tree.h"

namespace palpa::anatomy {

/// Turns one surface's crossings with the needle (of length `passes->length`; they are sorted here)
/// into stretches inside it, and puts those in their place among the others.
void addPasses(std::span<TriangleTree::Crossing> crossings, Organ organ, int surface,
               NeedlePasses* passes);

/// The needle lies in this surface from end to end.
void addWhole(Organ organ, int surface, NeedlePasses* passes);

}  // namespace palpa::anatomy
