#pragma once

#include "anatomy/volume/ct_patient.h"

namespace palpa::anatomy {

/// Rows from the top, three bytes (red, green, blue) a pixel.
struct Picture {
  int width = 0, height = 0;
  std::vector<std::uint8_t> rgb;
};

/// The brightest of the scan seen from in front, from the patient's left and from below, as
/// radiologists hang them (patient's right on the left), 1 mm a pixel, with the outlines of
/// `labels` and crosses at `marks`.
Picture projections(const Scan& scan, const std::vector<const LabelledOrgan*>& labels,
                    const Seeds& marks);

}  // namespace palpa::anatomy
