#include <gtest/gtest.h>

#include <opencv2/imgproc.hpp>

#include "anatomy/base/error.h"
#include "tests/twin/plate_views.h"

/// Several boards in one picture: the nearest sheet is seen, and only what is there.
namespace palpa::twin {
namespace {

bool equal(const cv::Mat& a, const cv::Mat& b) {
  return a.size() == b.size() && a.type() == b.type() && cv::norm(a, b, cv::NORM_INF) == 0;
}

TEST(VirtualPlates, ThereIsNoBoardOnABareTableNorOnAWallAndBothHaveMildStructure) {
  const Pose a = benchView(1, 0.5), b = benchView(2, 0.5);
  for (const Ground ground : {Ground::kWall, Ground::kBareTable}) {
    const VirtualCamera camera(benchLens(), kTable, kClean, 7, {ground, {}});
    const cv::Mat picture = camera.render(a, 0);
    EXPECT_TRUE(detector().detect(picture).empty());
    cv::Mat mean, deviation;
    cv::meanStdDev(picture(cv::Rect(270, 190, 100, 100)), mean, deviation);
    EXPECT_NEAR(mean.at<double>(0), 105, 10);
    EXPECT_GT(deviation.at<double>(0), 1);
    EXPECT_LT(deviation.at<double>(0), 15);
    EXPECT_EQ(equal(picture, camera.render(b, 0)), ground == Ground::kWall);
  }
}

TEST(VirtualPlates, ArePicturesOfSeedFrameAndPosesAlone) {
  const VirtualScene scene{Ground::kTableWithBoard, {kSmall, kSingle}};
  const VirtualCamera alone(benchLens(), kTable, {}, 7), camera(benchLens(), kTable, {}, 7, scene),
      again(benchLens(), kTable, {}, 7, scene);
  const Pose X_CW = benchView(1, 0.5);
  const PlatePose plates[] = {{0, facing(1, {0, 0, 0.3}, rad(20))},
                              {1, facing(2, {0.01, 0, 0.35}, rad(20))}};
  const PlatePose other_order[] = {plates[1], plates[0]};
  const cv::Mat picture = camera.render(X_CW, plates, 5);
  camera.render(benchView(2, 0.4), {&plates[1], 1}, 6);  // leaves no trace
  EXPECT_TRUE(equal(camera.render(X_CW, plates, 5), picture));
  EXPECT_TRUE(equal(again.render(X_CW, plates, 5), picture));
  EXPECT_TRUE(equal(camera.render(X_CW, other_order, 5), picture));
  EXPECT_FALSE(equal(camera.render(X_CW, plates, 6), picture));
  EXPECT_FALSE(equal(camera.render(X_CW, {plates, 1}, 5), picture));
  EXPECT_TRUE(equal(camera.render(X_CW, {}, 5), alone.render(X_CW, 5)));
  EXPECT_TRUE(equal(camera.render(X_CW, 5), alone.render(X_CW, 5)));
}

bool has(const std::vector<ar::Tag>& tags, int id) {
  return std::any_of(tags.begin(), tags.end(), [&](const ar::Tag& tag) { return tag.id == id; });
}

/// Straight above tag 8 (third of the second row): the sheet is as large as the tag with its
/// margin.
TEST(VirtualPlates, APlateOverTheBoardHidesTagsAndOneUnderTheTableIsHidden) {
  const VirtualCamera camera(benchLens(), kTable, {}, 7, {Ground::kTableWithBoard, {kSingle}});
  const Pose X_CW = lookAt({0, 0, 0}, 0.5, 0, 0, 0);
  const Vec3 middle = (ar::tagCorners(kTable, 8)[0] + ar::tagCorners(kTable, 8)[2]) / 2;
  const auto at = [&](double z) {
    return PlatePose{0, X_CW * makePose(Mat3::Identity(), middle + Vec3(0, 0, z))};
  };
  for (const double z : {0.02, 1e-5, 0.0}) {  // the last: it lies on the table
    const PlatePose above = at(z);
    const auto tags = detector().detect(camera.render(X_CW, {&above, 1}, 0));
    EXPECT_TRUE(has(tags, kSingle.first_id)) << z;
    EXPECT_FALSE(has(tags, 8)) << z;
    EXPECT_TRUE(has(tags, 0) && has(tags, 23)) << z;
  }
  const cv::Mat bare = camera.render(X_CW, 0);
  for (const double z : {-0.001, -0.1, -5.0}) {
    const PlatePose below = at(z);
    EXPECT_TRUE(equal(camera.render(X_CW, {&below, 1}, 0), bare)) << z;
  }
  const PlatePose behind_camera{0, facing(1, {0, 0, -0.3}, 0)};
  EXPECT_TRUE(equal(camera.render(X_CW, {&behind_camera, 1}, 0), bare));
  const PlatePose turned{0, turnedOver(at(0.02).X_CB)};
  const auto tags = detector().detect(camera.render(X_CW, {&turned, 1}, 0));
  EXPECT_FALSE(has(tags, kSingle.first_id) || has(tags, 8));
}

/// Which sheet the ray through a pixel meets first, found point by point; -1: none.
int firstMet(const Vec3& ray, const std::vector<ar::TagGridSpec>& specs,
             const std::vector<PlatePose>& plates) {
  int first = -1;
  double nearest = 1e9;
  for (std::size_t i = 0; i < plates.size(); ++i) {
    const Pose X_BC = plates[i].X_CB.inverse();
    const Vec3 o = X_BC.translation(), d = X_BC.linear() * ray;
    const double t = -o.z() / d.z();
    const Vec3 p = o + t * d;
    const Eigen::Vector2d half = ar::sheetSize(specs[plates[i].plate]) / 2;
    if (t <= 0 || t >= nearest || std::abs(p.x()) > half.x() || std::abs(p.y()) > half.y())
      continue;
    nearest = t;
    first = int(i);
  }
  return first;
}

cv::Mat ownersOf(const CameraModel& lens, const std::vector<ar::TagGridSpec>& specs,
                 const std::vector<PlatePose>& plates) {
  cv::Mat owners(lens.height, lens.width, CV_8S);
  for (int v = 0; v < lens.height; ++v)
    for (int u = 0; u < lens.width; ++u)
      owners.at<signed char>(v, u) =
          static_cast<signed char>(firstMet(lens.unproject({double(u), double(v)}), specs, plates));
  return owners;
}

/// True where a pixel's eight neighbours have the same owner.
bool inside(const cv::Mat& owners, int v, int u) {
  for (int dv = -1; dv <= 1; ++dv)
    for (int du = -1; du <= 1; ++du)
      if (owners.at<signed char>(v + dv, u + du) != owners.at<signed char>(v, u)) return false;
  return true;
}

/// Any poses: overlapping, cutting through each other, partly out of sight, partly behind the
/// camera, face on and from behind.
TEST(VirtualPlates, EachPixelShowsTheNearestSheetThatItsRayMeets) {
  const std::vector<ar::TagGridSpec> specs{kSmall, kSingle, kHandheld};
  const CameraModel lens = strongLens();
  const VirtualCamera camera(lens, kTable, kClean, 7, {Ground::kWall, specs});
  std::array<int, 4> pixels{};
  for (std::uint64_t i = 0; i < 12; ++i) {
    std::vector<PlatePose> plates;
    for (std::uint64_t k = 0; k < 3; ++k) {
      const double far = k == 2 ? 0.3 : 0.2;
      const Vec3 p_C(draw(3 * i + k, 8, -0.08, 0.08), draw(3 * i + k, 9, -0.06, 0.06),
                     draw(3 * i + k, 10, k == 2 ? 0.02 : 0.1, far));
      Pose X = facing(3 * i + k, p_C, rad(80));
      const bool edge_on = std::abs(X.inverse().translation().z()) < 0.2 * p_C.norm();
      if (edge_on) X = facing(3 * i + k, p_C, 0);  // thinner than a pixel no ray need meet it
      plates.push_back({k, draw(3 * i + k, 11, 0, 1) < 0.4 ? turnedOver(X) : X});
    }
    std::array<cv::Mat, 4> alone{camera.render(kNowhere, 0)};
    for (std::size_t k = 0; k < 3; ++k) alone[k + 1] = camera.render(kNowhere, {&plates[k], 1}, 0);
    const cv::Mat all = camera.render(kNowhere, plates, 0), owners = ownersOf(lens, specs, plates);
    int wrong = 0;
    for (int v = 1; v + 1 < lens.height; ++v)
      for (int u = 1; u + 1 < lens.width; ++u) {
        if (!inside(owners, v, u)) continue;
        const std::size_t owner = std::size_t(owners.at<signed char>(v, u) + 1);
        ++pixels[owner];
        wrong += all.at<unsigned char>(v, u) != alone[owner].at<unsigned char>(v, u);
      }
    EXPECT_EQ(wrong, 0) << i;
  }
  for (const int count : pixels) EXPECT_GT(count, 10000);  // or nothing was tested
}

TEST(VirtualPlates, RefusesWhatCannotBe) {
  const VirtualCamera camera(benchLens(), kTable, {}, 7, {Ground::kWall, {kSmall}});
  const PlatePose unknown{1, facing(1, {0, 0, 0.3}, 0)};
  EXPECT_THROW(camera.render(kNowhere, {&unknown, 1}, 0), UsageError);
  PlatePose lost{0, facing(1, {0, 0, 0.3}, 0)};
  lost.X_CB.translation().z() = std::nan("");
  EXPECT_THROW(camera.render(kNowhere, {&lost, 1}, 0), UsageError);
  EXPECT_THROW(VirtualCamera(benchLens(), kTable, {}, 7, {Ground::kWall, {{0, 1, 0.03, 0.01, 0}}}),
               UsageError);
}

}  // namespace
}  // namespace palpa::twin
