#pragma once

#include <zlib.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <functional>
#include <string>

#include "anatomy/volume/volume.h"

/// Volumes of known content, and files of them written by the tests' own hand.
namespace palpa::anatomy::test {

inline Volume sampled(const Index3& size, const Mat3& steps, const Vec3& origin,
                      const std::function<float(const Vec3&)>& value_at_S) {
  Volume v;
  v.size = size, v.steps_S = steps, v.origin_S = origin;
  for (int k = 0; k < size[2]; ++k)
    for (int j = 0; j < size[1]; ++j)
      for (int i = 0; i < size[0]; ++i) v.values.push_back(value_at_S(v.pointToS(Vec3(i, j, k))));
  return v;
}

template <class T>
std::string bytesOfVoxels(const Volume& v, bool swapped = false) {
  std::string out;
  for (const float value : v.values) {
    const T voxel = static_cast<T>(value);
    char raw[sizeof(T)];
    std::memcpy(raw, &voxel, sizeof(T));
    if (swapped) std::reverse(raw, raw + sizeof(T));
    out.append(raw, sizeof(T));
  }
  return out;
}

inline std::string deflated(const std::string& bytes, bool gzip) {
  z_stream s{};
  deflateInit2(&s, 6, Z_DEFLATED, gzip ? 31 : 15, 8, Z_DEFAULT_STRATEGY);
  std::string out(deflateBound(&s, bytes.size()) + 64, '\0');
  s.next_in = reinterpret_cast<Bytef*>(const_cast<char*>(bytes.data())),
  s.avail_in = static_cast<uInt>(bytes.size());
  s.next_out = reinterpret_cast<Bytef*>(out.data()), s.avail_out = static_cast<uInt>(out.size());
  deflate(&s, Z_FINISH);
  out.resize(s.total_out);
  deflateEnd(&s);
  return out;
}

inline std::string row(const Vec3& v) {
  return std::to_string(v.x()) + " " + std::to_string(v.y()) + " " + std::to_string(v.z()) + " ";
}

inline std::string asMha(const Volume& v, const std::string& type, const std::string& voxels,
                         bool packed, bool msb = false) {
  const Mat3 unit = v.steps_S.colwise().normalized();
  const std::string data = packed ? deflated(voxels, false) : voxels;
  return "ObjectType = Image\nNDims = 3\nBinaryData = True\nBinaryDataByteOrderMSB = " +
         std::string(msb ? "True" : "False") + "\nCompressedData = " + (packed ? "True" : "False") +
         "\nTransformMatrix = " + row(unit.col(0)) + row(unit.col(1)) + row(unit.col(2)) +
         "\nOffset = " + row(1e3 * v.origin_S) + "\nElementSpacing = " + row(1e3 * v.spacing()) +
         "\nDimSize = " + std::to_string(v.size[0]) + " " + std::to_string(v.size[1]) + " " +
         std::to_string(v.size[2]) + "\nElementType = " + type + "\nElementDataFile = LOCAL\n" +
         data;
}

/// By sform; with `quaternion` (a, b, c, d of a rotation in RAS and qfac) by qform instead.
inline std::string asNifti(const Volume& v, int type, int bits, const std::string& voxels,
                           bool by_sform, const double* qfac_bcd = nullptr) {
  std::string h(352, '\0');
  const auto put = [&](std::size_t at, auto value) {
    std::memcpy(h.data() + at, &value, sizeof value);
  };
  put(0, std::int32_t{348});
  put(40, std::int16_t{3});
  for (std::size_t a = 0; a < 3; ++a)
    put(42 + 2 * a, static_cast<std::int16_t>(v.size[a])),
        put(80 + 4 * a, static_cast<float>(1e3 * v.spacing()[static_cast<int>(a)]));
  put(70, static_cast<std::int16_t>(type)), put(72, static_cast<std::int16_t>(bits));
  put(108, 352.f), put(112, 1.f);
  h[123] = 2;
  const Vec3 turn(-1, -1, 1);
  const Mat3 ras = 1e3 * turn.asDiagonal() * v.steps_S;
  const Vec3 origin = 1e3 * turn.cwiseProduct(v.origin_S);
  if (by_sform) {
    put(254, std::int16_t{1});
    for (int r = 0; r < 3; ++r) {
      for (int c = 0; c < 3; ++c)
        put(280 + 16 * static_cast<std::size_t>(r) + 4 * static_cast<std::size_t>(c),
            static_cast<float>(ras(r, c)));
      put(292 + 16 * static_cast<std::size_t>(r), static_cast<float>(origin[r]));
    }
  } else if (qfac_bcd) {
    put(252, std::int16_t{1});
    put(76, static_cast<float>(qfac_bcd[0]));
    for (std::size_t a = 0; a < 3; ++a)
      put(256 + 4 * a, static_cast<float>(qfac_bcd[a + 1])),
          put(268 + 4 * a, static_cast<float>(origin[static_cast<int>(a)]));
  }
  std::memcpy(h.data() + 344, "n+1", 4);
  return h + voxels;
}

}  // namespace palpa::anatomy::test
