#include "anatomy/volume/raw_voxels.h"

#include <zlib.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>

#include "anatomy/base/error.h"

namespace palpa::anatomy {
namespace {

constexpr std::size_t kMostInflation = 1032;  // of deflate (zlib's technical notes)

[[noreturn]] void refuseVolume(const std::string& what, const std::string& where) {
  throw Error(what, where, kVolumeRemedy);
}

template <class T>
void convert(const char* from, std::size_t count, bool swapped, double slope, double intercept,
             float* to) {
  for (std::size_t n = 0; n < count; ++n) {
    char raw[sizeof(T)];
    std::memcpy(raw, from + n * sizeof(T), sizeof(T));
    if (swapped) std::reverse(raw, raw + sizeof(T));
    T value;
    std::memcpy(&value, raw, sizeof(T));
    const double scaled = static_cast<double>(value) * slope + intercept;
    to[n] = std::abs(scaled) <= static_cast<double>(std::numeric_limits<float>::max())
                ? static_cast<float>(scaled)
                : std::numeric_limits<float>::quiet_NaN();
  }
}

void mendGaps(std::vector<float>* values, const std::string& where) {
  float least = std::numeric_limits<float>::infinity();
  for (const float v : *values)
    if (v < least) least = v;
  if (!std::isfinite(least)) refuseVolume("none of its values is a number", where);
  for (float& v : *values)
    if (!std::isfinite(v)) v = least;
}

struct Inflater {
  z_stream stream{};
  explicit Inflater(std::string_view packed, const std::string& where) {
    stream.next_in = reinterpret_cast<Bytef*>(const_cast<char*>(packed.data()));
    stream.avail_in =
        static_cast<uInt>(std::min<std::size_t>(packed.size(), std::numeric_limits<uInt>::max()));
    if (inflateInit2(&stream, 15 + 32) != Z_OK)
      refuseVolume("zlib cannot start", where);  // 32: zlib or gzip by their heads
  }
  ~Inflater() { inflateEnd(&stream); }
};

}  // namespace

std::size_t bytesOf(VoxelType type) {
  switch (type) {
    case VoxelType::int8:
    case VoxelType::uint8:
      return 1;
    case VoxelType::int16:
    case VoxelType::uint16:
      return 2;
    case VoxelType::float64:
      return 8;
    default:
      return 4;
  }
}

std::vector<float> voxelsOf(std::string_view bytes, VoxelType type, std::size_t count, bool swapped,
                            double slope, double intercept, const std::string& where) {
  if (bytes.size() / bytesOf(type) < count)
    refuseVolume("it holds " + std::to_string(bytes.size()) +
                     " bytes of voxels where its header promises " +
                     std::to_string(count * bytesOf(type)),
                 where);
  std::vector<float> values(count);
  const auto as = [&](auto sample) {
    convert<decltype(sample)>(bytes.data(), count, swapped, slope, intercept, values.data());
  };
  switch (type) {
    case VoxelType::int8:
      as(std::int8_t{});
      break;
    case VoxelType::uint8:
      as(std::uint8_t{});
      break;
    case VoxelType::int16:
      as(std::int16_t{});
      break;
    case VoxelType::uint16:
      as(std::uint16_t{});
      break;
    case VoxelType::int32:
      as(std::int32_t{});
      break;
    case VoxelType::uint32:
      as(std::uint32_t{});
      break;
    case VoxelType::float32:
      as(float{});
      break;
    case VoxelType::float64:
      as(double{});
      break;
  }
  mendGaps(&values, where);
  return values;
}

std::string inflated(std::string_view packed, std::size_t size, bool whole,
                     const std::string& where) {
  if (whole && size / kMostInflation > packed.size() + 1)
    refuseVolume("its header promises " + std::to_string(size) + " bytes, more than " +
                     std::to_string(packed.size()) + " compressed bytes can hold",
                 where);
  Inflater inflater(packed, where);
  std::string out(size + 1, '\0');  // one more: to see whether it would go on
  z_stream& s = inflater.stream;
  s.next_out = reinterpret_cast<Bytef*>(out.data());
  s.avail_out =
      static_cast<uInt>(std::min<std::size_t>(out.size(), std::numeric_limits<uInt>::max()));
  const int result = inflate(&s, Z_FINISH);
  const std::size_t got = out.size() - s.avail_out;
  if (result == Z_DATA_ERROR || result == Z_NEED_DICT || result == Z_STREAM_ERROR ||
      result == Z_MEM_ERROR)
    if (whole || got == 0) refuseVolume("its compressed part is damaged", where);
  if (whole && got > size)
    refuseVolume("its compressed part holds more than the header says", where);
  if (whole && (got < size || result != Z_STREAM_END))
    refuseVolume("its compressed part ends too early", where);
  out.resize(std::min(got, size));
  return out;
}

}  // namespace palpa::anatomy
