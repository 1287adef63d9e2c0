#include <gtest/gtest.h>

#include "anatomy/base/error.h"
#include "anatomy/import/repair.h"
#include "anatomy/import/surface_topology.h"
#include "sample_meshes.h"
#include "tests/support/counts.h"
#include "tests/support/damage.h"

/// Files that nobody vouches for: sound ones with bits flipped, bytes replaced, ends cut off,
/// numbers blown up, parts swapped. Each gives a surface or a clear word; under the sanitizers
/// nothing else is seen either.
namespace palpa::anatomy {
namespace {

using namespace test;
using namespace palpa::test;

std::string damaged(std::string bytes, DamageDice& dice) {
  static const char* const kAbsurd[] = {
      "4294967295",       "-1",       "1e999", "nan", "inf", "99999999999999999999", "0",
      "\xff\xff\xff\xff", "[[[[[[[[", "{"};
  switch (dice.below(7)) {
    case 0:
      bytes.resize(dice.below(bytes.size()));
      break;
    case 1:
      bytes.insert(dice.below(bytes.size()), kAbsurd[dice.below(std::size(kAbsurd))]);
      break;
    case 2: {
      const std::size_t from = dice.below(bytes.size()), length = dice.below(64);
      bytes.erase(from, length);
      break;
    }
    case 3: {  // a number becomes another
      const std::size_t at = bytes.find_first_of("0123456789", dice.below(bytes.size()));
      if (at != std::string::npos) bytes.replace(at, 1, kAbsurd[dice.below(std::size(kAbsurd))]);
      break;
    }
    default:
      for (std::size_t i = 0, n = 1 + dice.below(8); i < n && !bytes.empty(); ++i) {
        char& byte = bytes[dice.below(dice.below(2) ? bytes.size()
                                                    : std::min<std::size_t>(bytes.size(), 300))];
        if (dice.below(2))
          byte = static_cast<char>(byte ^ (1 << dice.below(8)));
        else
          byte = static_cast<char>(dice.below(256));
      }
  }
  return bytes;
}

int casesAFormat() { return palpa::test::counted(400, 4000); }

TEST(MeshFuzz, DamageGivesASurfaceOrAClearWord) {
  const RawMesh mesh = box();
  const std::pair<MeshFormat, std::string> sound[] = {
      {MeshFormat::obj, asObj(mesh)},        {MeshFormat::stl, asStl(mesh, true)},
      {MeshFormat::stl, asStl(mesh, false)}, {MeshFormat::ply, asPly(mesh, 't')},
      {MeshFormat::ply, asPly(mesh, 'l')},   {MeshFormat::ply, asPly(mesh, 'b')},
      {MeshFormat::gltf, asGlb(mesh)}};
  DamageDice dice(20'261'121);
  int read = 0, refused = 0;
  for (const auto& [format, bytes] : sound)
    for (int i = 0; i < casesAFormat(); ++i) {
      std::string harmed = damaged(bytes, dice);
      if (dice.below(3) == 0) harmed = damaged(std::move(harmed), dice);
      try {
        for (const RawMesh& found : readMesh(format, harmed, "damaged")) {
          const SurfaceCheck check = checkSurface(found);
          ASSERT_GT(check.triangles, 0u);
          ASSERT_TRUE(check.low.allFinite() && check.high.allFinite());
          findings(check);
          RepairReport report;
          const SurfaceCheck after = checkSurface(repaired(found, &report));
          ASSERT_EQ(after.degenerate + after.repeated_triangles + after.repeated_points, 0u);
        }
        ++read;
      } catch (const Error& error) {
        ASSERT_NO_FATAL_FAILURE(expectClearWord(error, "damaged"));
        ++refused;
      }
    }
  EXPECT_GT(read, casesAFormat() / 4) << "some damage does no harm";
  EXPECT_GT(refused, casesAFormat());
  expectLessThan2GiB();
}

}  // namespace
}  // namespace palpa::anatomy
