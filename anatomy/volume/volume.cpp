#include "anatomy/volume/volume.h"

#include <algorithm>
#include <cmath>
#include <fstream>

#include "anatomy/base/error.h"
#include "anatomy/base/whole_file.h"

namespace palpa::anatomy {
namespace {

constexpr double kShortestStep = 0.05e-3, kLongestStep = 20e-3, kFarthestOrigin = 10;
constexpr double kFlattest = 0.5;  // determinant of the unit axes: 1 for square ones
constexpr int kLongestSide = 4096;

/// Axis of S that a letter lies on, and which way.
struct AxisLetter {
  int axis;
  double sign;
};

AxisLetter letterOf(char letter, const std::string& axes) {
  switch (letter) {
    case 'L':
      return {0, 1};
    case 'R':
      return {0, -1};
    case 'P':
      return {1, 1};
    case 'A':
      return {1, -1};
    case 'S':
      return {2, 1};
    case 'I':
      return {2, -1};
    default:
      throw UsageError(
          "is \"" + axes + "\"", "--ct-axes",
          "Give three letters of L/R, A/P, S/I, e.g. LPS: where columns, rows, slices point");
  }
}

/// For each axis of the grid the axis of S that it is nearest to, each once: the assignment with
/// the largest sum of cosines.
std::array<int, 3> nearestAxes(const Mat3& steps) {
  const Mat3 unit = steps.colwise().normalized();
  std::array<int, 3> order{0, 1, 2}, best = order;
  double most = -1;
  do {
    double sum = 0;
    for (int a = 0; a < 3; ++a) sum += std::abs(unit(order[static_cast<std::size_t>(a)], a));
    if (sum > most + 1e-9) most = sum, best = order;
  } while (std::next_permutation(order.begin(), order.end()));
  return best;
}

}  // namespace

void checkGeometry(const Volume& volume, const std::string& where) {
  const auto refuse = [&](const std::string& what) {
    throw Error(what, where, "Export the volume again or take another file");
  };
  std::size_t voxels = 1;
  for (const int n : volume.size) {
    if (n < 2 || n > kLongestSide)
      refuse("a side of " + std::to_string(n) + " voxels is not between 2 and 4096");
    voxels *= static_cast<std::size_t>(n);
  }
  if (voxels > kMostVoxels)
    refuse("it has " + std::to_string(voxels) + " voxels, more than 512 x 512 x 1024");
  if (!volume.steps_S.allFinite() || !volume.origin_S.allFinite())
    refuse("spacing, directions or origin are not numbers");
  const Vec3 spacing = volume.spacing();
  if (spacing.minCoeff() < kShortestStep || spacing.maxCoeff() > kLongestStep)
    refuse("the spacing is not between 0.05 and 20 mm");
  const Mat3 unit = volume.steps_S.colwise().normalized();
  if (std::abs(unit.determinant()) < kFlattest) refuse("the axes do not span a volume");
  if (volume.origin_S.cwiseAbs().maxCoeff() > kFarthestOrigin)
    refuse("the origin is more than 10 m away");
}

std::string axesOf(const Volume& volume) {
  static constexpr const char* kLetters[3] = {"RL", "AP", "IS"};
  const std::array<int, 3> axis = nearestAxes(volume.steps_S);
  std::string letters;
  for (int a = 0; a < 3; ++a) {
    const int to = axis[static_cast<std::size_t>(a)];
    letters += kLetters[to][volume.steps_S(to, a) > 0];
  }
  return letters;
}

void overrideAxes(const std::string& axes, bool mirrored, Volume* volume) {
  if (axes.size() != 3) letterOf('?', axes);
  const Vec3 spacing = volume->spacing();
  Mat3 steps = Mat3::Zero();
  for (int a = 0; a < 3; ++a) {
    const AxisLetter letter = letterOf(axes[static_cast<std::size_t>(a)], axes);
    steps(letter.axis, a) = letter.sign * spacing[a];
  }
  if (steps.determinant() == 0)
    throw UsageError("\"" + axes + "\" names one direction twice", "--ct-axes",
                     "Give one each of L/R, A/P, S/I");
  const bool turns_hand = (steps.determinant() > 0) != (volume->steps_S.determinant() > 0);
  if (turns_hand && !mirrored)
    throw UsageError("\"" + axes + "\" is of the other hand than the file's header (" +
                         axesOf(*volume) + "): left and right would change places",
                     "--ct-axes",
                     "Check the letters; if the file really is mirrored, add --ct-mirrored");
  volume->steps_S = steps;
}

Volume alongBody(const Volume& volume) {
  const std::array<int, 3> to = nearestAxes(volume.steps_S);
  std::array<int, 3> from{};  // grid axis that lies along each axis of S
  for (int a = 0; a < 3; ++a) from[static_cast<std::size_t>(to[static_cast<std::size_t>(a)])] = a;
  Volume out;
  Vec3 corner = Vec3::Zero();
  std::array<std::ptrdiff_t, 3> stride{};
  std::ptrdiff_t start = 0;
  const std::array<std::ptrdiff_t, 3> strides{
      1, volume.size[0], static_cast<std::ptrdiff_t>(volume.size[0]) * volume.size[1]};
  for (std::size_t b = 0; b < 3; ++b) {
    const auto a = static_cast<std::size_t>(from[b]);
    const int n = volume.size[a];
    const bool backward = volume.steps_S(static_cast<int>(b), static_cast<int>(a)) < 0;
    out.size[b] = n;
    out.steps_S.col(static_cast<int>(b)) =
        (backward ? -1 : 1) * volume.steps_S.col(static_cast<int>(a));
    stride[b] = backward ? -strides[a] : strides[a];
    if (!backward) continue;
    corner[static_cast<int>(a)] = n - 1;
    start += strides[a] * (n - 1);
  }
  out.origin_S = volume.pointToS(corner);
  out.values.resize(volume.values.size());
  std::size_t write = 0;
  for (int k = 0; k < out.size[2]; ++k)
    for (int j = 0; j < out.size[1]; ++j)
      for (int i = 0; i < out.size[0]; ++i)
        out.values[write++] = volume.values[static_cast<std::size_t>(
            start + i * stride[0] + j * stride[1] + k * stride[2])];
  return out;
}

namespace {

constexpr std::uintmax_t kLargestVolumeFile = std::uintmax_t{2} << 30;

std::string loadVolume(const std::filesystem::path& file) {
  std::error_code failure;
  const std::uintmax_t size = std::filesystem::file_size(file, failure);
  if (failure)
    throw Error("cannot be opened (" + whyUnread(failure) + ")", file.string(), "Check the name");
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
