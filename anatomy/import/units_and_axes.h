#pragma once

#include <optional>
#include <string>

#include "anatomy/geometry/local_geometry.h"
#include "anatomy/geometry/pose.h"

namespace palpa::anatomy {

/// A unit of length that files are written in.
struct Unit {
  const char* name;   ///< "mm"
  const char* words;  ///< "millimetres"
  double metres;
};

/// m, cm, mm, um, in, ft by name; nothing for another name.
std::optional<Unit> unitNamed(const std::string& name);
std::string knownUnits();  ///< "m, cm, mm, um, in, ft"

/// Whether an adult's organ can be so long: its longest side, m. Sources: clavicle 149 +- 10 mm;
/// others from anatomical atlases, generously.
bool plausibleLength(Organ organ, double longest_m);

/// The first unit (in the order of knownUnits) in which a side of `longest` would be plausible for
/// the organ.
std::optional<Unit> likelyUnit(Organ organ, double longest);

/// "1.4 km", "149 mm": a length in the unit in which people would say it.
std::string lengthText(double metres);

/// Axes of a file, said by three letters: where its +x, +y and +z point. L and R: the patient's
/// left and right, A and P: anterior and posterior, S and I: superior and inferior. "LPS" is frame
/// A itself, "LSA" glTF's custom (y up, z front).
struct FileAxes {
  /// v_A = A_from_file * v_file; a turn, or a turn and a mirror
  Mat3 A_from_file = Mat3::Identity();
  bool rightHanded() const { return A_from_file.determinant() > 0; }
};

/// Nothing unless the letters name three different directions, one of each pair.
std::optional<FileAxes> axesNamed(const std::string& letters);

}  // namespace palpa::anatomy
