#pragma once

#include <memory>

extern "C" {
#include <apriltag/apriltag.h>
#include <apriltag/tag36h11.h>
}

namespace palpa::ar {

using TagFamily = std::unique_ptr<apriltag_family_t, decltype(&tag36h11_destroy)>;

/// The family tag36h11 with a black border `border_bits` cells wide, 1 or 2. The codes are the
/// same; a border of two cells, as Kalibr prints it, makes the tag 10 cells wide instead of 8. Part
/// of the tags with the other border may decode, because the cells sampled lie within half a cell
/// of the true ones; they have their own ids and the same outer corners then. The caller owns the
/// family, which must outlive its detector.
TagFamily makeTagFamily(int border_bits);

}  // namespace palpa::ar
