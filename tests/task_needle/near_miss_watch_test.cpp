#include "apps/task_needle/near_miss_watch.h"

#include <gtest/gtest.h>

#include "tests/support/simple_patient.h"

namespace palpa::task_needle {
namespace {

/// A lung and an artery as spheres of 20 mm, 200 mm apart.
anatomy::Patient twoSpheres() {
  anatomy::Patient patient;
  const auto add = [&](Organ organ, const Vec3& centre) {
    anatomy::OrganSurface surface;
    surface.organ = organ;
    surface.id = name(organ);
    surface.mesh = test::sphere(centre, Vec3::Constant(0.02), 96);
    patient.organs.push_back(surface);
  };
  add(Organ::lung, Vec3::Zero());
  add(Organ::artery, Vec3(0.2, 0, 0));
  return patient;
}

class NearMissWatchTest : public testing::Test {
 protected:
  std::string at(double from_lung_mm, bool inserted = true, std::uint32_t trial = 1) {
    return watch_.look(Vec3(0, 0, 0.02 + 1e-3 * from_lung_mm), inserted, trial);
  }
  const anatomy::Patient patient_ = twoSpheres();
  const anatomy::SurfaceQuery query_{patient_};
  NearMissWatch watch_{patient_, query_};
};

TEST_F(NearMissWatchTest, TellsEveryWholeMillimetreNearerOnce) {
  EXPECT_EQ(at(7), "");
  EXPECT_EQ(at(5.5), "");
  EXPECT_EQ(at(4.5), "4.5 mm from the pleura");
  EXPECT_EQ(at(4.2), "");  // trembling tells nothing
  EXPECT_EQ(at(4.6), "");
  EXPECT_EQ(at(2.5), "2.5 mm from the pleura");
  EXPECT_EQ(at(3.5), "");  // on the way out, neither
  EXPECT_EQ(at(0.5), "0.5 mm from the pleura");
  EXPECT_EQ(at(-1), "");  // contact is told by others
}

TEST_F(NearMissWatchTest, BeginsAnewWithTheNextPassAndTheNextTrial) {
  EXPECT_NE(at(2.5), "");
  EXPECT_EQ(at(2.5), "");
  EXPECT_EQ(at(2.5, false), "");  // out: not a miss
  EXPECT_NE(at(2.5), "");
  EXPECT_NE(at(2.5, true, 2), "");
}

TEST_F(NearMissWatchTest, NamesTheArtery) {
  EXPECT_EQ(watch_.look(Vec3(0.2, 0, 0.0235), true, 1), "3.5 mm from an artery");
}

}  // namespace
}  // namespace palpa::task_needle
