#include <gtest/gtest.h>

#include <cmath>
#include <opencv2/calib3d.hpp>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>

#include "anatomy/base/quantile.h"
#include "apps/trial/look_watch.h"
#include "apps/twin/virtual_camera.h"
#include "ar/cameras/undistort.h"
#include "scene/view/scene_view.h"
#include "tests/support/camera_views.h"
#include "tests/support/simple_patient.h"
#include "tests/support/test_data.h"

/// Whether the overlay and what the camera saw look like one picture: told from the pixels of
/// finished frames, by other means than those that measure the camera.
namespace palpa::trial {
namespace {

using Point = Eigen::Vector2d;

ar::TagGridSpec board() { return {.columns = 2, .rows = 2, .tag_size = 0.05, .spacing = 0.0125}; }

/// A square bright sheet on the table beside the board, towards the camera.
constexpr double kHalf = 0.03;
const Vec3 kSheet_W(0.12, 0, 0);

Pose X_WA() {
  Mat3 R_WA;
  R_WA.col(0) = Vec3::UnitX();
  R_WA.col(1) = -Vec3::UnitZ();
  R_WA.col(2) = Vec3::UnitY();
  return makePose(R_WA, kSheet_W);
}

/// White: as bright as bone.
anatomy::Patient sheetAlone(float gray) {
  anatomy::Patient patient;
  test::add(patient, "clavicle", Organ::clavicle,
            test::sheet(
                kHalf, [](double, double) { return 0.0; }, 2));
  patient.organs.back().rgba = {gray, gray, gray, 1};
  return patient;
}

struct Frame {
  cv::Mat gray;
  double scale = 1;  ///< of the camera's picture
  calibration::CameraModel pinhole;
  Pose X_CW;

  Point scaled(const Point& p) const { return (p.array() + 0.5) * scale - 0.5; }
  Point at(const Vec3& p_W) const { return scaled(pinhole.project(X_CW * p_W)); }
};

scene::GlContextProvider& context() {
  static const auto context = scene::makeGlContext(scene::Display::offscreen, 640, 480, "test");
  return *context;
}

scene::CameraLook lookOf(const cv::Mat& seen, const cv::Rect& where = {}) {
  LookWatch watch;
  watch.see(seen, where, 0);
  return watch.look();
}

/// The sheet over these pictures, which `frame` says from where they were taken; their mean.
Frame over(const std::vector<cv::Mat>& pictures, Frame frame, const scene::CameraLook& look,
           float gray = 1) {
  const calibration::CameraModel& p = frame.pinhole;
  scene::SceneState state;
  state.registered = true;
  state.show_tool = false;
  state.look = look;
  state.camera = {p.width, p.height, p.fx, p.fy, p.cx, p.cy};
  state.X_CA = frame.X_CW * X_WA();
  const int width = int(frame.scale * p.width), height = int(frame.scale * p.height);
  scene::SceneView view(context(), sheetAlone(gray),
                        {width, height, scene::FixedViews::none, true});
  cv::Mat3d sum(height, width, cv::Vec3d());
  for (const cv::Mat& seen : pictures) {
    cv::Mat rgb;
    cv::cvtColor(seen, rgb, seen.channels() == 1 ? cv::COLOR_GRAY2RGB : cv::COLOR_BGR2RGB);
    scene::Image picture{rgb.cols, rgb.rows, 3, {rgb.datastart, rgb.dataend}};
    state.picture = &picture;
    view.show(state);
    scene::Image shown = view.capture();
    cv::accumulate(cv::Mat(height, width, CV_8UC3, shown.pixels.data()), sum);
  }
  cv::Mat mean;
  sum.convertTo(mean, CV_8U, 1.0 / double(pictures.size()));
  cv::cvtColor(mean, frame.gray, cv::COLOR_RGB2GRAY);
  return frame;
}

Frame frameOf(const twin::VirtualCameraSettings& settings, double scale, bool matched = true,
              std::size_t pictures = 1) {
  const calibration::CameraModel lens = test::webcam();
  const twin::VirtualCamera camera(lens, board(), settings, 5);
  const ar::Undistorter undistorter(lens);
  const Pose X_CW = test::lookAt({0.03, 0, 0}, 0.36, test::rad(4), 0, test::rad(7));
  std::vector<cv::Mat> seen;
  while (seen.size() < pictures)
    seen.push_back(undistorter.apply(camera.render(X_CW, seen.size())));
  return over(seen, {{}, scale, undistorter.pinhole(), X_CW},
              matched ? lookOf(seen.front()) : scene::CameraLook());
}

/// From 10 to 90 % of the step across the straight line from `a` to `b`, pixels of the camera;
/// pixels near the middle of the line, sorted by their distance (as ISO 12233 has it).
double riseAcross(const Frame& frame, const Point& a, const Point& b, double far = 8.4) {
  const double kBin = far < 8 ? 0.4 : 0.2;
  const Point middle = 0.5 * (a + b);
  const Point along = (b - a).normalized(), across(-along.y(), along.x());
  const double reach = far * frame.scale, length = 0.3 * (b - a).norm();
  std::vector<double> sum(std::size_t(std::lround(2 * far / kBin))), count(sum.size());
  for (int v = 0; v < frame.gray.rows; ++v)
    for (int u = 0; u < frame.gray.cols; ++u) {
      const Point from = Point(u, v) - middle;
      const double d = from.dot(across);
      if (std::abs(from.dot(along)) > length || std::abs(d) >= reach) continue;
      const auto bin = std::min(std::size_t((d + reach) / (kBin * frame.scale)), sum.size() - 1);
      sum[bin] += frame.gray.at<std::uint8_t>(v, u);
      count[bin] += 1;
    }
  std::vector<double> level(sum.size());
  for (std::size_t i = 0; i < level.size(); ++i)
    level[i] = count[i] > 0 ? sum[i] / count[i] : i > 0 ? level[i - 1] : 0;
  const std::size_t side = level.size() / 6;
  const auto mean = [&](std::size_t from) {
    double all = 0;
    for (std::size_t i = from; i < from + side; ++i) all += level[i];
    return all / double(side);
  };
  const double first = mean(0), last = mean(level.size() - side);
  const auto crossing = [&](double share) {
    const double wanted = first + share * (last - first);
    for (std::size_t i = side; i + side < level.size(); ++i)
      if ((level[i] - wanted) * (level[i + 1] - wanted) <= 0 && level[i] != level[i + 1])
        return kBin * (double(i) + (wanted - level[i]) / (level[i + 1] - level[i]));
    return std::nan("");
  };
  return crossing(0.9) - crossing(0.1);
}

/// Of what is left beside the mean of each 12 x 12 pixels about here.
double grainAround(const Frame& frame, const Point& p) {
  const int half = int(12 * frame.scale);
  const cv::Rect where(int(p.x()) - half, int(p.y()) - half, 2 * half, 2 * half);
  cv::Mat1f here, mean;
  frame.gray(where).convertTo(here, CV_32F);
  cv::blur(here, mean, {2 * (half / 2) + 1, 2 * (half / 2) + 1});
  cv::Scalar ignored, sigma;
  cv::meanStdDev(here - mean, ignored, sigma);
  return sigma[0];
}

Vec3 corner(double x, double y) { return kSheet_W + Vec3(x * kHalf, y * kHalf, 0); }

/// The mean of the four sides of a square.
double riseAround(const Frame& frame, const std::array<Vec3, 4>& corners_W) {
  double sum = 0;
  for (std::size_t i = 0; i < 4; ++i)
    sum += std::abs(riseAcross(frame, frame.at(corners_W[i]), frame.at(corners_W[(i + 1) % 4])));
  return sum / 4;
}

double riseOfBoard(const Frame& frame) {
  double sum = 0;
  for (int tag = 0; tag < 4; ++tag) sum += riseAround(frame, ar::tagCorners(board(), tag)) / 4;
  return sum;
}
double riseOfSheet(const Frame& frame) {
  return riseAround(frame, {corner(-1, -1), corner(1, -1), corner(1, 1), corner(-1, 1)});
}

struct Setting {
  double blur_px, noise, exposure, scale;
};
class BenchCameras : public testing::TestWithParam<Setting> {
 protected:
  twin::VirtualCameraSettings settings() const {
    twin::VirtualCameraSettings settings;
    settings.blur_sigma_px = GetParam().blur_px;
    settings.noise_sigma = GetParam().noise;
    settings.exposure = GetParam().exposure;
    return settings;
  }
};
INSTANTIATE_TEST_SUITE_P(OnePicture, BenchCameras,
                         testing::Values(Setting{0.55, 3, 0.85, 1}, Setting{0.75, 6, 0.65, 1},
                                         Setting{1.1, 4.5, 0.75, 1}, Setting{1.5, 7, 0.8, 1},
                                         Setting{0.7, 5, 0.7, 1.5}, Setting{0.9, 3.5, 0.8, 1.25}));

TEST_P(BenchCameras, BlurOverlayAndBoardAlike) {
  constexpr std::size_t kPictures = 6;  // their mean has less grain, and edges that can be measured
  const Frame frame = frameOf(settings(), GetParam().scale, true, kPictures);
  const double real = riseOfBoard(frame);
  const double shown = riseOfSheet(frame);
  EXPECT_NEAR(shown, real, 0.1 * real);
  RecordProperty("shown_over_real", std::to_string(shown / real));
  EXPECT_LT(riseOfSheet(frameOf(settings(), GetParam().scale, false)), 0.9 * real);
}

TEST_P(BenchCameras, GrainOverlayAndTableAlike) {
  const Frame frame = frameOf(settings(), GetParam().scale);
  double real = 0;  // straightening a picture smooths it here more and there less
  for (const double x : {0.12, 0.15})
    for (const double y : {-0.06, 0.06}) real += grainAround(frame, frame.at({x, y, 0})) / 4;
  const double shown = grainAround(frame, frame.at(kSheet_W));
  EXPECT_NEAR(shown, real, 0.1 * real);
  RecordProperty("shown_over_real", std::to_string(shown / real));
  const Frame plain = frameOf(settings(), GetParam().scale, false);
  EXPECT_LT(grainAround(plain, plain.at(kSheet_W)), 0.2 * real);
}

TEST(OnePicture, AnOverlayIsAsBrightAsTheLight) {
  const auto levels = [](double exposure) {
    twin::VirtualCameraSettings settings;
    settings.exposure = exposure;
    const Frame frame = frameOf(settings, 1);
    const auto level = [&](const Vec3& p_W) {
      const Point p = frame.at(p_W);
      return cv::mean(frame.gray(cv::Rect(int(p.x()) - 5, int(p.y()) - 5, 10, 10)))[0];
    };
    return std::array{level(kSheet_W), level({0, 0, 0})};  // paper between the four tags
  };
  const auto light = levels(1), dim = levels(0.6);
  EXPECT_NEAR(dim[0] / light[0], dim[1] / light[1], 0.05);
}

/// Photographs of a chessboard; each edge between two of its inner corners is one to measure.
class RealPictures : public testing::TestWithParam<const char*> {};
INSTANTIATE_TEST_SUITE_P(Chessboard, RealPictures,
                         testing::Values("left01.jpg", "left02.jpg", "left03.jpg", "left04.jpg",
                                         "left05.jpg", "left06.jpg", "left07.jpg", "left08.jpg",
                                         "left09.jpg", "left11.jpg", "left12.jpg", "left13.jpg",
                                         "left14.jpg"));

struct Photograph {
  cv::Mat seen;
  std::vector<cv::Point2f> corners;
  cv::Rect board;
  Frame frame;

  Point corner(int k) const {
    const cv::Point2f& p = corners[static_cast<std::size_t>(k)];
    return {p.x, p.y};
  }
};
const cv::Size kInner(9, 6);

Photograph photograph(const std::filesystem::path& file) {
  Photograph p{cv::imread(file.string(), cv::IMREAD_COLOR), {}, {}, {}};
  EXPECT_TRUE(cv::findChessboardCorners(p.seen, kInner, p.corners));
  p.frame.pinhole = {p.seen.cols, p.seen.rows, 600, 600, p.seen.cols / 2.0, p.seen.rows / 2.0};
  p.frame.X_CW = test::lookAt({0.03, 0, 0}, 0.5, 0, 0, test::rad(7));
  cv::cvtColor(p.seen, p.frame.gray, cv::COLOR_BGR2GRAY);
  cv::cornerSubPix(p.frame.gray, p.corners, {5, 5}, {-1, -1}, {});
  const cv::Rect all = cv::boundingRect(p.corners);
  p.board = {all.x - 20, all.y - 20, all.width + 40, all.height + 40};
  return p;
}

/// The sheet where there is nothing else: a room would hide an edge.
Frame sheetAs(const Photograph& p, float gray = 1) {
  const cv::Mat even(p.seen.size(), CV_8UC3, cv::Scalar::all(60));
  return over({even}, {{}, 1, p.frame.pinhole, p.frame.X_CW}, lookOf(p.seen, p.board), gray);
}

TEST_P(RealPictures, BlurOverlayAndBoardAlike) {
  const auto file = testData("chessboard") / GetParam();
  PALPA_NEED_DATA(file);
  const Photograph p = photograph(file);
  std::array<std::vector<double>, 2> rises;  // along rows, along columns
  for (int i = 0; i + 1 < kInner.area(); ++i)
    for (const int next : {1, kInner.width}) {
      if (next == 1 ? (i + 1) % kInner.width == 0 : i + next >= kInner.area()) continue;
      const double rise = riseAcross(p.frame, p.corner(i), p.corner(i + next), 6);
      if (std::isfinite(rise)) rises[next == 1 ? 0 : 1].push_back(std::abs(rise));
    }
  const double real = 0.5 * (quantile(rises[0], 0.5) + quantile(rises[1], 0.5));
  const double shown = riseOfSheet(sheetAs(p));
  EXPECT_NEAR(shown, real, 0.1 * real);
  RecordProperty("shown_over_real", std::to_string(shown / real));
}

/// What a plane does not explain of a square of pixels; and its level.
struct Even {
  double level = 0, variance = 0;
};
Even evenAt(const cv::Mat& gray, const cv::Rect& square) {
  const auto n = static_cast<Eigen::Index>(square.area());
  Eigen::MatrixX3d A(n, 3);
  Eigen::VectorXd y(n);
  Eigen::Index row = 0;
  for (int v = 0; v < square.height; ++v)
    for (int u = 0; u < square.width; ++u, ++row) {
      A.row(row) << 1, u, v;
      y[row] = gray.at<std::uint8_t>(square.y + v, square.x + u);
    }
  const Eigen::Vector3d plane = A.colPivHouseholderQr().solve(y);
  return {y.mean(), (y - A * plane).squaredNorm() / double(n - 3)};
}

constexpr int kSquare = 14;  // px, of the places where grain is measured

/// Of the places as bright as `level` where a picture is even, on average: smoothed they rise or
/// fall by `most_rise` at most.
double grainAt(const cv::Mat& gray, double level, double most_rise) {
  constexpr double kAlike = 25;
  constexpr int kMargin = 3;
  cv::Mat1f smooth;
  gray.convertTo(smooth, CV_32F);
  cv::GaussianBlur(smooth, smooth, {0, 0}, 2.5);
  std::vector<double> variances;
  for (int v = kMargin; v + kSquare + kMargin < gray.rows; v += kSquare / 2)
    for (int u = kMargin; u + kSquare + kMargin < gray.cols; u += kSquare / 2) {
      const cv::Rect square(u, v, kSquare, kSquare);
      double low = 0, high = 0;
      cv::minMaxLoc(smooth(square), &low, &high);
      if (high - low > most_rise || std::abs(0.5 * (low + high) - level) > kAlike) continue;
      variances.push_back(evenAt(gray, square).variance);
    }
  EXPECT_GT(variances.size(), 15u);
  double sum = 0;
  for (const double variance : variances) sum += variance;
  return std::sqrt(sum / double(variances.size()));
}

/// What the grain of these pictures is depends on which places count as even (JPEG leaves none in
/// some blocks and shapes in others): by a strict and by a lenient rule 1.5 and 2.5 of 255. The
/// overlay's is to lie between, give or take a tenth.
TEST_P(RealPictures, GrainOverlayAndRoomAlike) {
  const auto file = testData("chessboard") / GetParam();
  PALPA_NEED_DATA(file);
  const Photograph p = photograph(file);
  const Frame frame = sheetAs(p, 0.35F);
  const Point middle = frame.at(kSheet_W);
  double variance = 0, level = 0;
  int places = 0;
  for (int v = -1; v <= 1; ++v)
    for (int u = -1; u <= 1; ++u, ++places) {
      const Even even =
          evenAt(frame.gray, {int(middle.x()) + kSquare * u - kSquare / 2,
                              int(middle.y()) + kSquare * v - kSquare / 2, kSquare, kSquare});
      variance += even.variance;
      level += even.level;
    }
  const double shown = std::sqrt(variance / places);
  const double strict = grainAt(p.frame.gray, level / places, 3),
               lenient = grainAt(p.frame.gray, level / places, 10);
  EXPECT_GE(shown, 0.9 * strict);
  EXPECT_LE(shown, 1.1 * lenient);
  RecordProperty("shown_over_strict", std::to_string(shown / strict));
}

}  // namespace
}  // namespace palpa::trial
