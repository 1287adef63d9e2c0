#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <string_view>

#include "anatomy/volume/volume.h"

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
