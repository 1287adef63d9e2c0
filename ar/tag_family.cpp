#include "ar/tag_family.h"

#include "anatomy/geometry/error.h"

namespace palpa::ar {

TagFamily makeTagFamily(int border_bits) {
  if (border_bits != 1 && border_bits != 2)
    throw UsageError("the border must be 1 or 2 cells wide", "tag family", "Use 1, or 2 (Kalibr).");
  TagFamily family(tag36h11_create(), &tag36h11_destroy);
  // The structure and its bit places are this caller's own; only the codes are the library's.
  const int wider = border_bits - 1;
  family->width_at_border += 2 * wider;
  family->total_width += 2 * wider;
  for (unsigned i = 0; i < family->nbits; ++i) {  // counted from the border's upper left cell
    family->bit_x[i] += unsigned(wider);
    family->bit_y[i] += unsigned(wider);
  }
  return family;
}

}  // namespace palpa::ar
