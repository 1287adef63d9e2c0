#include "apps/calibrate/recorded.h"

#include <gtest/gtest.h>

#include <fstream>

#include "a_calibration.h"
#include "anatomy/base/error.h"
#include "tests/support/counts.h"
#include "tests/support/damage.h"
#include "tests/support/scratch_folder.h"

namespace palpa::calibrate {
namespace {

using palpa::test::says;

class SampleTables : public testing::Test {
 protected:
  std::filesystem::path file(const std::string& text, const std::string& name = "samples.csv") {
    std::ofstream(folder_ / name, std::ios::binary) << text;
    return folder_ / name;
  }
  template <class Read>
  std::string whyRefused(Read read) {
    try {
      read();
    } catch (const Error& e) {
      return e.what();
    }
    return "";
  }
  test::ScratchFolder folder_{"sample_table"};
};

TEST_F(SampleTables, ReadInMillimetresAndMetres) {
  const auto mm =
      readPoses(file("t_s,x_mm,y_mm,z_mm,q_w,q_x,q_y,q_z\n# a remark\n0,1,2,3,1,0,0,0\n"));
  const auto m = readPoses(file("x_m,y_m,z_m,q_w,q_x,q_y,q_z\r\n0.001, 0.002 ,0.003,1,0,0,0\r\n"));
  ASSERT_EQ(mm.size(), 1u);
  EXPECT_LT((mm[0].translation() - Vec3(0.001, 0.002, 0.003)).norm(), 1e-15);
  EXPECT_LT((mm[0].matrix() - m[0].matrix()).norm(), 1e-15);
}

TEST_F(SampleTables, ALengthWithoutUnitIsRefused) {
  EXPECT_TRUE(says(whyRefused([&] { readPoses(file("x,y,z,q_w,q_x,q_y,q_z\n1,2,3,1,0,0,0\n")); }),
                   "does not say its unit"));
}

TEST_F(SampleTables, WhatIsWrongIsToldWithItsPlace) {
  const auto poses = [&](const std::string& text) {
    return whyRefused([&] { readPoses(file(text)); });
  };
  EXPECT_TRUE(
      says(poses("x_m,y_m,z_m,q_w,q_x,q_y,q_z\n1,2,nan,1,0,0,0\n"), "line 2, column \"z_m\""));
  EXPECT_TRUE(says(poses("x_m,y_m,z_m,q_w,q_x,q_y,q_z\n1,2,3,1,0,0\n"),
                   "has 6 cells where the header has 7"));
  EXPECT_TRUE(says(poses("x_m,y_m,z_m,q_w,q_x,q_y,q_z\n1,2,3,2,0,0,0\n"), "not a unit quaternion"));
  EXPECT_TRUE(says(poses("x_m,y_m,q_w,q_x,q_y,q_z\n1,2,1,0,0,0\n"), "has no column \"z_m\""));
  EXPECT_TRUE(says(poses("x_m,y_m,z_m,q_w,q_x,q_y,q_z\n"), "holds no samples"));
  EXPECT_TRUE(says(poses(""), "holds no samples"));
  EXPECT_TRUE(says(whyRefused([&] { readPoses(folder_ / "none.csv"); }), "cannot be read"));
  EXPECT_TRUE(
      says(whyRefused([&] { readPosePairs(file("[[1,2]]", "pairs.json")); }), "not a 4x4 matrix"));
  EXPECT_TRUE(says(whyRefused([&] { readPosePairs(file("{}", "pairs.json")); }), "holds no list"));
}

TEST_F(SampleTables, DamagedTablesAreTold) {
  std::string good =
      "name,known_x_mm,known_y_mm,known_z_mm,touched_x_mm,touched_y_mm,touched_z_mm,for\n";
  for (int i = 0; i < 12; ++i)
    good += "L" + std::to_string(i) + ",1.5,2.5,-3.5,1e1,22.25,-0.125," +
            (i % 4 ? "fit" : "check") + "\n";
  test::DamageDice dice(7);
  const int cases = test::counted(1000, 5000);
  for (int i = 0; i < cases; ++i) {
    std::string text = good;
    for (std::size_t hits = 1 + dice.below(4); hits > 0; --hits)
      text[dice.below(text.size())] = static_cast<char>(dice.below(256));
    const std::filesystem::path damaged = file(text);
    const std::string why = whyRefused([&] {
      for (const Touch& t : readTouches(damaged))
        ASSERT_TRUE(t.p_W.allFinite() && t.p_D.allFinite());
    });
    ASSERT_EQ(why.find('\n'), std::string::npos) << why;
    ASSERT_TRUE(why.empty() || says(why, damaged.string())) << why;
  }
  test::expectLessThan2GiB();
}

}  // namespace
}  // namespace palpa::calibrate
