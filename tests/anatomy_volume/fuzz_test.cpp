#include <gtest/gtest.h>

#include <cstdlib>
#include <random>

#include "anatomy/geometry/error.h"
#include "anatomy/volume/readers.h"
#include "sample_volumes.h"

/// Damaged volumes: each gives a valid volume or a clear word in one line; under the sanitizers nothing else is seen either.
namespace palpa::anatomy {
namespace {

using namespace test;

std::size_t below(std::mt19937_64& bits, std::size_t n) { return n ? static_cast<std::size_t>(bits() % n) : 0; }

std::string harmed(std::string bytes, std::mt19937_64& bits) {
  static const char* const kAbsurd[] = {"4294967295", "-1", "1e999", "nan", "inf", "99999999999999999999", "0", "\xff\xff\xff\xff", "= =", "\n"};
  const std::size_t head = std::min<std::size_t>(bytes.size(), 400);
  switch (below(bits, 6)) {
    case 0: bytes.resize(below(bits, bytes.size())); break;
    case 1: bytes.insert(below(bits, head), kAbsurd[below(bits, std::size(kAbsurd))]); break;
    case 2: bytes.erase(below(bits, bytes.size()), below(bits, 64)); break;
    case 3: {
      const std::size_t at = bytes.find_first_of("0123456789", below(bits, head));
      if (at != std::string::npos) bytes.replace(at, 1, kAbsurd[below(bits, std::size(kAbsurd))]);
      break;
    }
    default:
      for (std::size_t i = 0, n = 1 + below(bits, 8); i < n && !bytes.empty(); ++i)
        bytes[below(bits, below(bits, 3) ? head : bytes.size())] ^= static_cast<char>(1 << below(bits, 8));
  }
  return bytes;
}

int casesAFile() {
  const char* full = std::getenv("PALPA_FULL");
  return full && std::string(full) == "1" ? 2000 : 250;
}

TEST(VolumeFuzz, DamageGivesAVolumeOrAClearWord) {
  const Mat3 steps = Vec3(1e-3, 1.5e-3, 2e-3).asDiagonal();
  const Volume v = sampled({9, 8, 7}, steps, Vec3::Zero(), [](const Vec3& p) { return static_cast<float>(std::round(40 * std::sin(900 * p.sum()))); });
  const std::string shorts = bytesOfVoxels<std::int16_t>(v), floats = bytesOfVoxels<float>(v);
  const std::string nifti = asNifti(v, 16, 32, floats, true);
  const std::string sound[] = {asMha(v, "MET_SHORT", shorts, false), asMha(v, "MET_SHORT", shorts, true), nifti, deflated(nifti, true), asNifti(v, 4, 16, shorts, false)};
  std::mt19937_64 bits(20'261'122);
  int read = 0, refused = 0;
  for (std::size_t f = 0; f < std::size(sound); ++f)
    for (int i = 0; i < casesAFile(); ++i) {
      const std::string bytes = harmed(sound[f], bits);
      try {
        const Volume found = f < 2 ? readMetaImage(bytes, "damaged", [](const std::string&) { return std::string(); }) : readNifti(bytes, "damaged");
        ASSERT_EQ(found.values.size(), static_cast<std::size_t>(found.size[0]) * static_cast<std::size_t>(found.size[1]) * static_cast<std::size_t>(found.size[2]));
        ASSERT_TRUE(found.steps_S.allFinite() && found.origin_S.allFinite());
        for (const float value : found.values) ASSERT_TRUE(std::isfinite(value));
        ++read;
      } catch (const Error& error) {
        const std::string words = error.what();
        ASSERT_EQ(words.find('\n'), std::string::npos) << words;
        ASSERT_EQ(words.rfind("damaged: ", 0), 0u) << words;
        ++refused;
      }
    }
  EXPECT_GT(read, casesAFile() / 4);
  EXPECT_GT(refused, casesAFile());
}

}  // namespace
}  // namespace palpa::anatomy
