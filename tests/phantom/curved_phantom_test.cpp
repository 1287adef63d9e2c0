#include <gtest/gtest.h>

#include <cmath>

#include "apps/twin/phantom/phantom_file.h"
#include "apps/twin/phantom/phantom_twin.h"

/// Silicone with a curved top, as it truly is.
namespace palpa::twin {
namespace {

constexpr double kTick = 2.5e-4;

PhantomTable plain() {
  const std::filesystem::path folder = std::filesystem::path(PALPA_SOURCE_DIR) / "assets/phantoms";
  return readSolved(folder / "mockups.json", folder / "mockups.tables.json").front().table;
}

TopShape mound() {
  TopShape top;
  top.arch_high = 0.025;
  top.arch_half_x = top.arch_half_y = 0.05;
  top.arch_foot = 0.01;
  return onOrigin(top);
}

/// Held for a second over a place of the top, so deep; the last touch.
PhantomTouch held(const TopShape& top, const PhantomTable& table, const Vec3& place, double depth) {
  CurvedPhantomTwin twin(table, SiliconeLaw{}, top);
  PhantomTouch touch;
  for (int i = 0; i < 20000; ++i)
    touch = twin.step(fromTop(top, Vec3(place.x(), place.y(), table.tool_radius - depth)), kTick);
  return touch;
}

TEST(CurvedPhantom, PushesAlongTheNormalByTheDepthAlongIt) {
  const PhantomTable table = plain();
  const TopShape top = mound();
  for (const Vec3& place : {Vec3(0, 0, 0), Vec3(0.02, 0.01, 0), Vec3(-0.03, 0.02, 0)}) {
    const PhantomTouch touch = held(top, table, place, 0.004);
    const auto [most, least] = curvaturesOf(top, place.x(), place.y());
    const double hertz = 1 / std::sqrt(1 + table.tool_radius * (most + least) / 2);
    ASSERT_TRUE(touch.contact);
    EXPECT_LT(touch.f.normalized().cross(normalOf(top, place.x(), place.y())).norm(), 1e-6);
    EXPECT_NEAR(touch.f_n, hertz * table.at(0, 0.004).f_up, 5e-3 * touch.f_n);
    EXPECT_LT(hertz, 1) << "a ball on a ball has less of it to press on";
  }
  EXPECT_FALSE(held(top, table, Vec3(0.02, 0, 0), -1e-4).contact);
}

/// Where the top hardly curves it is the flat block's middle.
TEST(CurvedPhantom, IsTheFlatBlockWhereItIsFlat) {
  const PhantomTable table = plain();
  TopShape almost;
  almost.hollow = 1e-9;
  CurvedPhantomTwin curved(table, SiliconeLaw{}, onOrigin(almost));
  PhantomTwin flat(table, SiliconeLaw{});
  for (int i = 0; i < 4000; ++i) {
    const double z = -0.005 * std::sin(1e-3 * i);
    const PhantomTouch a = curved.step(Vec3(0, 0, z + table.tool_radius), kTick),
                       b = flat.step(Vec3(0, 0, z), kTick);
    ASSERT_LT((a.f - b.f).norm(), 1e-6);
  }
}

TEST(CurvedPhantom, RubsAlongItsTop) {
  const PhantomTable table = plain();
  const TopShape top = mound();
  CurvedPhantomTwin twin(table, SiliconeLaw{}, top);
  PhantomTouch touch;
  for (int i = 0; i < 4000; ++i)
    touch = twin.step(fromTop(top, Vec3(-0.01 + 5e-6 * i, 0.01, table.tool_radius - 0.004)), kTick);
  const Vec3 n = normalOf(top, 0.01, 0.01), along = (touch.f - touch.f_n * n) / touch.f_n;
  EXPECT_LT(std::abs((touch.f - touch.f_n * n).dot(n)), 0.02 * touch.f_n);
  EXPECT_LT(along.x(), -0.25) << "against the stroke, by about mu";
  EXPECT_GT(along.norm(), 0.3);
  EXPECT_LT(along.norm(), 0.5);
}

}  // namespace
}  // namespace palpa::twin
