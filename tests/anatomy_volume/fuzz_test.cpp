#include <gtest/gtest.h>

#include "anatomy/base/error.h"
#include "anatomy/volume/volume.h"
#include "sample_volumes.h"
#include "tests/support/counts.h"
#include "tests/support/damage.h"

/// Damaged volumes: each gives a valid volume or a clear word in one line; under the sanitizers
/// nothing else is seen either.
namespace palpa::anatomy {
namespace {

using namespace test;
using namespace palpa::test;

std::string harmed(std::string bytes, DamageDice& dice) {
  static const char* const kAbsurd[] = {
      "4294967295",       "-1",  "1e999", "nan", "inf", "99999999999999999999", "0",
      "\xff\xff\xff\xff", "= =", "\n"};
  const std::size_t head = std::min<std::size_t>(bytes.size(), 400);
  switch (dice.below(6)) {
    case 0:
      bytes.resize(dice.below(bytes.size()));
      break;
    case 1:
      bytes.insert(dice.below(head), kAbsurd[dice.below(std::size(kAbsurd))]);
      break;
    case 2:
      bytes.erase(dice.below(bytes.size()), dice.below(64));
      break;
    case 3: {
      const std::size_t at = bytes.find_first_of("0123456789", dice.below(head));
      if (at != std::string::npos) bytes.replace(at, 1, kAbsurd[dice.below(std::size(kAbsurd))]);
      break;
    }
    default:
      for (std::size_t i = 0, n = 1 + dice.below(8); i < n && !bytes.empty(); ++i)
        bytes[dice.below(dice.below(3) ? head : bytes.size())] ^=
            static_cast<char>(1 << dice.below(8));
  }
  return bytes;
}

int casesAFile() { return palpa::test::counted(250, 2000); }

TEST(VolumeFuzz, DamageGivesAVolumeOrAClearWord) {
  const Mat3 steps = Vec3(1e-3, 1.5e-3, 2e-3).asDiagonal();
  const Volume v = sampled({9, 8, 7}, steps, Vec3::Zero(), [](const Vec3& p) {
    return static_cast<float>(std::round(40 * std::sin(900 * p.sum())));
  });
  const std::string shorts = bytesOfVoxels<std::int16_t>(v), floats = bytesOfVoxels<float>(v);
  const std::string nifti = asNifti(v, 16, 32, floats, true);
  const std::string sound[] = {asMha(v, "MET_SHORT", shorts, false),
                               asMha(v, "MET_SHORT", shorts, true), nifti, deflated(nifti, true),
                               asNifti(v, 4, 16, shorts, false)};
  DamageDice dice(20'261'122);
  int read = 0, refused = 0;
  for (std::size_t f = 0; f < std::size(sound); ++f)
    for (int i = 0; i < casesAFile(); ++i) {
      const std::string bytes = harmed(sound[f], dice);
      try {
        const Volume found = f < 2 ? readMetaImage(bytes, "damaged",
                                                   [](const std::string&) { return std::string(); })
                                   : readNifti(bytes, "damaged");
        ASSERT_EQ(found.values.size(), static_cast<std::size_t>(found.size[0]) *
                                           static_cast<std::size_t>(found.size[1]) *
                                           static_cast<std::size_t>(found.size[2]));
        ASSERT_TRUE(found.steps_S.allFinite() && found.origin_S.allFinite());
        for (const float value : found.values) ASSERT_TRUE(std::isfinite(value));
        ++read;
      } catch (const Error& error) {
        ASSERT_NO_FATAL_FAILURE(expectClearWord(error, "damaged"));
        ++refused;
      }
    }
  EXPECT_GT(read, casesAFile() / 4);
  EXPECT_GT(refused, casesAFile());
  expectLessThan2GiB();
}

}  // namespace
}  // namespace palpa::anatomy
