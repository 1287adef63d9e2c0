#pragma once

#include <array>
#include <cstddef>
#include <filesystem>
#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include "anatomy/geometry/pose.h"

/// Volumes of a scanner. Frame S is DICOM's patient frame: +x patient's left, +y posterior, +z
/// superior, metres, origin where the scanner has it. Frame A has the same axes and its origin at
/// the suprasternal notch.
namespace palpa::anatomy {

using Index3 = std::array<int, 3>;

struct Volume {
  Index3 size{0, 0, 0};
  /// i runs fastest, then j, then k; CT: Hounsfield units if the file has them
  std::vector<float> values;
  /// columns: from a voxel's centre to the next along i, j, k, metres
  Mat3 steps_S = Mat3::Identity();
  Vec3 origin_S = Vec3::Zero();  ///< centre of voxel (0, 0, 0)

  std::size_t index(int i, int j, int k) const {
    return (static_cast<std::size_t>(k) * static_cast<std::size_t>(size[1]) +
            static_cast<std::size_t>(j)) *
               static_cast<std::size_t>(size[0]) +
           static_cast<std::size_t>(i);
  }
  float at(int i, int j, int k) const { return values[index(i, j, k)]; }
  Vec3 spacing() const { return steps_S.colwise().norm().transpose(); }
  Vec3 pointToS(const Vec3& ijk) const { return origin_S + steps_S * ijk; }
  Vec3 pointToIndex(const Vec3& p_S) const { return steps_S.inverse() * (p_S - origin_S); }
};

/// The most voxels that are read: 512 x 512 x 1024.
inline constexpr std::size_t kMostVoxels = std::size_t{1} << 28;

/// Refuses sizes, spacings and directions that no scan has: 2 to 4096 voxels a side, 0.05 to 20 mm
/// a step, axes that lie at least 30 degrees off each other's plane, origin within 10 m. Called
/// before memory is taken.
void checkGeometry(const Volume& volume, const std::string& where);

/// Where +i, +j, +k point, to the nearest axis: three letters of L/R, A/P, S/I, e.g. "LPS" for an
/// unturned volume.
std::string axesOf(const Volume& volume);

/// The volume with its i, j, k pointing where `axes` says, whatever its header said: spacing stays,
/// obliquity is dropped, and the first voxel's place becomes the origin. `mirrored` must be said
/// when the handedness is not that of the header, because left and right would change places.
/// Throws UsageError.
void overrideAxes(const std::string& axes, bool mirrored, Volume* volume);

/// The same samples with axes swapped and turned until i, j, k point as near as can be to left,
/// posterior, superior.
Volume alongBody(const Volume& volume);

}  // namespace palpa::anatomy

/// Readers of volumes. A size that a header claims is held against the bytes that are there, and
/// against kMostVoxels, before memory is taken for it; what is compressed is never inflated beyond
/// what its header says. All throw Error.
namespace palpa::anatomy {

/// By what the file is, not by its ending alone: MetaImage (.mha, .mhd), NIfTI-1 (.nii, .nii.gz), a
/// folder or a file of a DICOM series. `series`: which of several in a folder, by number (from 1)
/// or UID.
Volume readVolume(const std::filesystem::path& path, const std::string& series = "");

/// Gives the bytes of the file of voxels that stands beside a header (.mhd).
using BytesBeside = std::function<std::string(const std::string& name)>;

/// MetaImage: three dimensions, one channel, binary, zlib or plain. ITK's convention: its world is
/// S in millimetres; without a TransformMatrix, AnatomicalOrientation says where the axes come from
/// ("RAI" is an unturned volume).
Volume readMetaImage(std::string_view bytes, const std::string& where, const BytesBeside& beside);

/// NIfTI-1 in one file, plain or gzip. Its world is +x right-to-left turned (RAS), millimetres
/// unless it says otherwise: sform if there is one, else qform, else the spacing along an unturned
/// grid; values scaled by scl_slope, scl_inter.
Volume readNifti(std::string_view bytes, const std::string& where);

/// A folder with a DICOM series, or one file of it: slices of one orientation, sorted by their
/// place, evenly spaced; values by Rescale Slope and Intercept.
Volume readDicomSeries(const std::filesystem::path& path, const std::string& series);

}  // namespace palpa::anatomy
