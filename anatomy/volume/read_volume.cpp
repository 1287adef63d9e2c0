#include <fstream>

#include "anatomy/geometry/error.h"
#include "anatomy/volume/readers.h"

namespace palpa::anatomy {
namespace {

constexpr std::uintmax_t kLargestVolumeFile = std::uintmax_t{2} << 30;

std::string loadVolume(const std::filesystem::path& file) {
  std::error_code failure;
  const std::uintmax_t size = std::filesystem::file_size(file, failure);
  if (failure)
    throw Error("cannot be opened (" + failure.message() + ")", file.string(), "Check the name");
  if (size > kLargestVolumeFile)
    throw Error("is larger than 2 GiB", file.string(), "Export a part of it");
  std::ifstream stream(file, std::ios::binary);
  std::string bytes(static_cast<std::size_t>(size), '\0');
  stream.read(bytes.data(), static_cast<std::streamsize>(size));
  if (!stream) throw Error("cannot be read", file.string(), "Check its permissions");
  return bytes;
}

}  // namespace

Volume readVolume(const std::filesystem::path& path, const std::string& series) {
  const std::string name = path.filename().string();
  if (std::filesystem::is_directory(path)) return readDicomSeries(path, series);
  if (name.ends_with(".mha") || name.ends_with(".mhd"))
    return readMetaImage(loadVolume(path), path.string(), [&](const std::string& beside) {
      return loadVolume(path.parent_path() / beside);
    });
  if (name.ends_with(".nii") || name.ends_with(".nii.gz"))
    return readNifti(loadVolume(path), path.string());
  if (!std::filesystem::exists(path))
    throw Error("cannot be opened", path.string(), "Check the name");
  return readDicomSeries(path, series);
}

}  // namespace palpa::anatomy
