#include "apps/twin/virtual_camera.h"

#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>

#include "anatomy/geometry/error.h"
#include "apps/twin/virtual_camera_noise.h"
#include "apps/twin/virtual_camera_table.h"

namespace palpa::twin {
namespace {

using calibration::CameraModel;

// One stream a purpose, so that the table does not change with the noise.
constexpr std::uint64_t kTableStream = 1, kNoiseStream = 2, kRowStream = 3;

constexpr double kFinestTexel = 0.00025;  // metres: a pixel at 0.15 m with a focal length of 600 px
constexpr int kTextures = 10;             // sqrt(2) apart: the coarsest is 5.7 mm, a pixel at 3.4 m
constexpr double kTexelsPerPixel = 1.25;  // texture averaging plus interpolation then match a pixel
constexpr std::size_t kBank = 1U << 18;
constexpr int kNoiseUnit = 16;

void castRays(const CameraModel& camera, cv::Mat* x, cv::Mat* y) {
  x->create(camera.height, camera.width, CV_32F);
  y->create(camera.height, camera.width, CV_32F);
  for (int v = 0; v < camera.height; ++v)
    for (int u = 0; u < camera.width; ++u) {
      const Vec3 p = camera.unproject({double(u), double(v)});
      x->at<float>(v, u) = float(p.x());
      y->at<float>(v, u) = float(p.y());
    }
}

/// A lamp at the upper left, and the lens's fall-off toward the corners: 0.72 to 1.05 of the light.
cv::Mat lightFor(const CameraModel& camera, double exposure) {
  cv::Mat gain(camera.height, camera.width, CV_16U);
  for (int v = 0; v < gain.rows; ++v)
    for (int u = 0; u < gain.cols; ++u) {
      const double x = 2.0 * u / camera.width - 1, y = 2.0 * v / camera.height - 1;
      const double light = 1 - 0.06 * x - 0.05 * y - 0.09 * (x * x + y * y);
      gain.at<std::uint16_t>(v, u) = std::uint16_t(std::lround(256 * light * exposure));
    }
  return gain;
}

/// Takes (x, y, 1) on a pixel's ray to (X w, Y w, w) on the plane z_W = 0; w > 0 where the ray
/// meets it in front of the camera.
Mat3 rayToPlane(const Pose& X_CW) {
  const Pose X_WC = X_CW.inverse();
  const Vec3 o = X_WC.translation();
  const Mat3 R = X_WC.rotation();
  Mat3 H;
  H.row(0) = o.x() * R.row(2) - o.z() * R.row(0);
  H.row(1) = o.y() * R.row(2) - o.z() * R.row(1);
  H.row(2) = R.row(2);
  return o.z() > 0 ? Mat3(-H) : Mat3(Mat3::Zero());
}

/// Texels that the border repeats need no larger numbers.
float within(float texel) { return std::min(std::max(texel, -100.F), 20000.F); }

void check(const VirtualCameraSettings& s) {
  const auto between = [](double x, double low, double high) { return x >= low && x <= high; };
  if (!between(s.blur_sigma_px, 0, 5) || !between(s.noise_sigma, 0, 50) ||
      !between(s.exposure, 0.05, 10) || s.latency_ns < 0)
    throw UsageError(
        "blur must be 0 to 5 px, noise 0 to 50, exposure 0.05 to 10, latency not negative",
        "virtual camera", "Correct the settings of the virtual bench.");
}

}  // namespace

VirtualCamera::VirtualCamera(const CameraModel& truth, const ar::TagGridSpec& board,
                             const VirtualCameraSettings& settings, std::uint64_t seed)
    : truth_(truth), settings_(settings), seed_(seed) {
  check(settings);
  calibration::validate(truth, "virtual camera");
  ar::validate(board, "virtual camera");
  castRays(truth, &ray_x_, &ray_y_);
  gain_ = lightFor(truth, settings.exposure);
  noise_ = picture::noiseBank(picture::randomBits(seed, kNoiseStream),
                              settings.noise_sigma * kNoiseUnit, kBank);
  for (int i = 0; i < kTextures; ++i) {
    const double texel = kFinestTexel * std::pow(2.0, i / 2.0);
    if (board.tag_size / texel < 8) break;  // a cell is less than a texel: no tag left to see
    textures_.push_back(
        {picture::drawTable(board, texel, picture::randomBits(seed, kTableStream)), texel});
  }
}

const VirtualCamera::Texture& VirtualCamera::textureFor(const Pose& X_CW) const {
  const double distance = std::max(X_CW.translation().norm(), 1e-3);
  const double wanted = distance / truth_.fx / kTexelsPerPixel;
  const auto worse = [&](const Texture& a, const Texture& b) {
    return std::abs(std::log(a.texel / wanted)) < std::abs(std::log(b.texel / wanted));
  };
  return *std::min_element(textures_.begin(), textures_.end(), worse);
}

cv::Mat VirtualCamera::lookUp(const Pose& X_CW) const {
  const Texture& texture = textureFor(X_CW);
  const double cu = (texture.gray.cols - 1) / 2.0, cv_ = (texture.gray.rows - 1) / 2.0;
  Mat3 to_texel;
  to_texel << 1 / texture.texel, 0, cu, 0, -1 / texture.texel, cv_, 0, 0, 1;
  const Eigen::Matrix3f H = (to_texel * rayToPlane(X_CW)).cast<float>();
  cv::Mat column(ray_x_.size(), CV_32F), row(ray_x_.size(), CV_32F);
  for (int v = 0; v < ray_x_.rows; ++v) {
    const float *x = ray_x_.ptr<float>(v), *y = ray_y_.ptr<float>(v);
    float *to_column = column.ptr<float>(v), *to_row = row.ptr<float>(v);
    for (int u = 0; u < ray_x_.cols; ++u) {  // no branch, so that it runs on vectors
      const float w = H(2, 0) * x[u] + H(2, 1) * y[u] + H(2, 2);
      const float inverse = 1 / std::max(w, 1e-6F);
      const float k = w > 1e-6F ? inverse : 0.F;
      to_column[u] = within((H(0, 0) * x[u] + H(0, 1) * y[u] + H(0, 2)) * k);
      to_row[u] = within((H(1, 0) * x[u] + H(1, 1) * y[u] + H(1, 2)) * k);
    }
  }
  cv::Mat picture;
  cv::remap(texture.gray, picture, column, row, cv::INTER_LINEAR, cv::BORDER_REPLICATE);
  return picture;
}

/// Light, then noise: each row of each frame reads the bank from its own place, one of two signs.
void VirtualCamera::expose(std::uint64_t frame_number, cv::Mat* picture) const {
  const std::uint64_t frame =
      picture::randomBits(picture::randomBits(seed_, kRowStream), frame_number);
  const std::size_t width = std::size_t(picture->cols);
  for (int v = 0; v < picture->rows; ++v) {
    const std::uint64_t draw = picture::randomBits(frame, std::uint64_t(v));
    const std::int16_t* noise = noise_.data() + (draw >> 8) % (kBank - width);
    const int sign = (draw & 1U) ? 1 : -1;
    const std::uint16_t* gain = gain_.ptr<std::uint16_t>(v);
    unsigned char* pixel = picture->ptr<unsigned char>(v);
    for (std::size_t u = 0; u < width; ++u) {
      const int sixteenths = ((pixel[u] * gain[u]) >> 4) + sign * noise[u];
      pixel[u] = static_cast<unsigned char>(std::clamp((sixteenths + 8) >> 4, 0, 255));
    }
  }
}

cv::Mat VirtualCamera::render(const Pose& X_CW_true, std::uint64_t frame_number) const {
  cv::Mat picture = lookUp(X_CW_true);
  if (settings_.blur_sigma_px > 0)
    cv::GaussianBlur(picture, picture, {0, 0}, settings_.blur_sigma_px);
  expose(frame_number, &picture);
  return picture;
}

}  // namespace palpa::twin
