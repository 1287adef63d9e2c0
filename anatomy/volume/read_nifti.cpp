#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <map>

#include "anatomy/base/bytes.h"
#include "anatomy/volume/raw_voxels.h"
#include "anatomy/volume/volume.h"

namespace palpa::anatomy {
namespace {

constexpr std::size_t kHeader = 348, kMostExtensions = 1 << 20;
constexpr int kSwappedHeader = 1543569408;  // 348 in the other byte order

class Nifti {
 public:
  Nifti(std::string_view header, const std::string& where)
      : header_(header), where_(where), words_({}, where, kVolumeRemedy) {
    if (header.size() < kHeader) words_.fail("it is too short for NIfTI-1");
    const int size = at<std::int32_t>(0);
    swapped_ = size == kSwappedHeader;
    if (size != static_cast<int>(kHeader) && !swapped_)
      words_.fail("it is no NIfTI-1 (the header's size is wrong)");
    const std::string_view magic = header.substr(344, 3);
    if (magic == "ni1") words_.fail("its voxels are in another file (.img), which is not read");
    if (magic != "n+1") words_.fail("it is no NIfTI-1 (n+1 is missing)");
  }

  Volume geometry() const {
    Volume volume;
    const int dimensions = at<std::int16_t>(40);
    if (dimensions < 3 || dimensions > 7) words_.fail("it has not three dimensions");
    for (int d = 4; d <= dimensions; ++d)
      if (at<std::int16_t>(40 + 2 * static_cast<std::size_t>(d)) > 1)
        words_.fail("it holds several volumes");
    for (std::size_t a = 0; a < 3; ++a) volume.size[a] = at<std::int16_t>(42 + 2 * a);
    place(&volume);
    checkGeometry(volume, where_);
    return volume;
  }

  VoxelType type() const {
    static const std::map<int, VoxelType> kTypes{
        {2, VoxelType::uint8},    {4, VoxelType::int16},    {8, VoxelType::int32},
        {16, VoxelType::float32}, {64, VoxelType::float64}, {256, VoxelType::int8},
        {512, VoxelType::uint16}, {768, VoxelType::uint32}};
    const auto found = kTypes.find(at<std::int16_t>(70));
    if (found == kTypes.end())
      words_.fail("its kind of voxels (" + std::to_string(at<std::int16_t>(70)) + ") is not read");
    return found->second;
  }

  std::size_t offset() const {
    const double bytes = at<float>(108);
    if (!(bytes >= static_cast<double>(kHeader) && bytes <= static_cast<double>(kMostExtensions)))
      words_.fail("its voxels begin nowhere sensible");
    return static_cast<std::size_t>(bytes);
  }

  std::vector<float> voxels(std::string_view bytes, std::size_t count) const {
    double slope = at<float>(112), intercept = at<float>(116);
    if (slope == 0 || !std::isfinite(slope) || !std::isfinite(intercept))
      slope = 1, intercept = 0;  // 0: values as they are
    if (bytes.size() < offset()) words_.fail("it ends too early");
    return voxelsOf(bytes.substr(offset()), type(), count, swapped_, slope, intercept, where_);
  }

 private:
  template <class T>
  T at(std::size_t byte) const {
    ByteReader reader(header_, where_, kVolumeRemedy);
    reader.skip(byte);
    return reader.take<T>(swapped_);
  }

  double metresAUnit() const {
    const int unit = static_cast<unsigned char>(header_[123]) & 7;
    return unit == 1 ? 1 : unit == 3 ? 1e-6 : 1e-3;
  }

  // Rows of its world (RAS) turned to S: x and y change sign.
  void place(Volume* volume) const {
    const double unit = metresAUnit();
    Eigen::Matrix<double, 3, 4> to_ras;
    if (at<std::int16_t>(254) > 0) {
      for (int r = 0; r < 3; ++r)
        for (int c = 0; c < 4; ++c)
          to_ras(r, c) =
              at<float>(280 + 16 * static_cast<std::size_t>(r) + 4 * static_cast<std::size_t>(c));
    } else {
      to_ras = byQuaternion();
    }
    const Vec3 turn = unit * Vec3(-1, -1, 1);
    volume->steps_S = turn.asDiagonal() * to_ras.leftCols<3>();
    volume->origin_S = turn.cwiseProduct(to_ras.col(3));
  }

  // NIfTI-1, method 2: rotation from b, c, d (a >= 0), k turned by qfac; without a qform the
  // spacing alone.
  Eigen::Matrix<double, 3, 4> byQuaternion() const {
    Vec3 spacing;
    for (std::size_t a = 0; a < 3; ++a)
      spacing[static_cast<int>(a)] = std::abs(at<float>(80 + 4 * a));
    Eigen::Matrix<double, 3, 4> out = Eigen::Matrix<double, 3, 4>::Zero();
    Mat3 R = Mat3::Identity();
    if (at<std::int16_t>(252) > 0) {
      const double b = at<float>(256), c = at<float>(260), d = at<float>(264),
                   rest = 1 - b * b - c * c - d * d;
      if (!(rest > -1e-3)) words_.fail("its quaternion is no turn");
      R = Eigen::Quaterniond(std::sqrt(std::max(rest, 0.0)), b, c, d)
              .normalized()
              .toRotationMatrix();
      if (at<float>(76) < 0) R.col(2) = -R.col(2);
      for (std::size_t a = 0; a < 3; ++a) out(static_cast<int>(a), 3) = at<float>(268 + 4 * a);
    }
    out.leftCols<3>() = R * spacing.asDiagonal();
    return out;
  }

  std::string_view header_;
  std::string where_;
  ByteReader words_;
  bool swapped_ = false;
};

}  // namespace

Volume readNifti(std::string_view bytes, const std::string& where) {
  const bool packed = bytes.size() > 2 && bytes[0] == '\x1f' && bytes[1] == '\x8b';
  const std::string head =
      packed ? inflated(bytes, kHeader, false, where) : std::string(bytes.substr(0, kHeader));
  const Nifti nifti(head, where);
  Volume volume = nifti.geometry();
  const std::size_t count = static_cast<std::size_t>(volume.size[0]) *
                            static_cast<std::size_t>(volume.size[1]) *
                            static_cast<std::size_t>(volume.size[2]);
  if (!packed) {
    volume.values = nifti.voxels(bytes, count);
    return volume;
  }
  const std::string all =
      inflated(bytes, nifti.offset() + count * bytesOf(nifti.type()), true, where);
  volume.values = nifti.voxels(all, count);
  return volume;
}

}  // namespace palpa::anatomy
