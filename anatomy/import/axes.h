#pragma once

#include <optional>
#include <string>

#include "anatomy/geometry/pose.h"

namespace palpa::anatomy {

/// Axes of a file, said by three letters: where its +x, +y and +z point. L and R: the patient's
/// left and right, A and P: anterior and posterior, S and I: superior and inferior. "LPS" is frame
/// A itself, "LSA" glTF's custom (y up, z front).
struct FileAxes {
  Mat3 A_from_file =
      Mat3::Identity();  ///< v_A = A_from_file * v_file; a turn, or a turn and a mirror
  bool right_handed() const { return A_from_file.determinant() > 0; }
};

/// Nothing unless the letters name three different directions, one of each pair.
std::optional<FileAxes> axesNamed(const std::string& letters);

}  // namespace palpa::anatomy
