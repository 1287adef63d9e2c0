#include "apps/twin/virtual_camera.h"

#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>

#include "anatomy/base/error.h"
#include "apps/twin/virtual_camera_picture.h"

namespace palpa::twin {
namespace {

using calibration::CameraModel;

// One stream a purpose, so that the table does not change with the noise.
constexpr std::uint64_t kTableStream = 1, kNoiseStream = 2, kRowStream = 3, kWallStream = 4;

constexpr std::size_t kBank = 1U << 18;
constexpr int kNoiseUnit = 16;
constexpr double kBareTexel = 0.002;  // metres: the grain is smooth
constexpr double kWallDepth = 1;      // metres

void castRays(const CameraModel& camera, cv::Mat* x, cv::Mat* y) {
  x->create(camera.height, camera.width, CV_32F);
  y->create(camera.height, camera.width, CV_32F);
  for (int v = 0; v < camera.height; ++v) {
    Vec3 p = camera.unproject({0, double(v)});
    for (int u = 0; u < camera.width; ++u) {
      p = camera.unproject({double(u), double(v)}, p);
      x->at<float>(v, u) = float(p.x());
      y->at<float>(v, u) = float(p.y());
    }
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

/// Light, then noise of this sign, in 1/16 gray levels.
void exposeRow(const std::uint16_t* __restrict gain, const std::int16_t* __restrict noise, int sign,
               std::size_t count, unsigned char* __restrict pixel) {
  for (std::size_t u = 0; u < count; ++u) {
    const auto lit =
        static_cast<std::int32_t>(std::uint32_t{std::uint16_t{pixel[u]}} * std::uint32_t{gain[u]});
    const int sixteenths = (lit >> 4) + (sign < 0 ? -noise[u] : noise[u]);
    pixel[u] = static_cast<unsigned char>(std::clamp((sixteenths + 8) >> 4, 0, 255));
  }
}

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
                             const VirtualCameraSettings& settings, std::uint64_t seed,
                             const VirtualScene& scene)
    : truth_(truth), settings_(settings), seed_(seed) {
  check(settings);
  calibration::validate(truth, "virtual camera");
  ar::validate(board, "virtual camera");
  castRays(truth, &ray_x_, &ray_y_);
  gain_ = lightFor(truth, settings.exposure);
  noise_ = picture::noiseBank(picture::randomBits(seed, kNoiseStream),
                              settings.noise_sigma * kNoiseUnit, kBank);
  const std::uint64_t table = picture::randomBits(seed, kTableStream);
  if (scene.ground == VirtualScene::Ground::kTableWithBoard)
    textures_ = picture::TextureSeries(board.tag_size, [board, table](double texel) {
      return picture::drawTable(board, texel, table);
    });
  else if (scene.ground == VirtualScene::Ground::kBareTable)
    textures_ = picture::TextureSeries::ofOne(kBareTexel, [board, table](double texel) {
      return picture::drawBareTable(board, texel, table);
    });
  else
    wall_ = picture::drawWall(ray_x_, ray_y_, kWallDepth, picture::randomBits(seed, kWallStream));
  if (!scene.plates.empty()) blocks_ = picture::rayBlocks(ray_x_, ray_y_);
  for (const ar::TagGridSpec& plate : scene.plates) {
    ar::validate(plate, "plate of the virtual camera");
    const auto draw = [plate](double texel) { return picture::drawSheet(plate, texel); };
    plates_.push_back({ar::sheetSize(plate), picture::TextureSeries(plate.tag_size, draw)});
  }
}

cv::Mat VirtualCamera::lookUp(const picture::GrayTexture& texture, const Mat3& ray_to_plane,
                              const cv::Rect& region) const {
  const Eigen::Matrix3f H = (picture::toTexel(texture) * ray_to_plane).cast<float>();
  cv::Mat seen(region.size(), CV_8U);
  std::vector<std::int32_t> column(std::size_t(region.width)), row(column.size());
  for (int v = 0; v < region.height; ++v) {
    picture::castRow(H, ray_x_.ptr<float>(region.y + v) + region.x,
                     ray_y_.ptr<float>(region.y + v) + region.x, region.width, column.data(),
                     row.data());
    picture::readRow(texture.gray, column.data(), row.data(), region.width,
                     seen.ptr<unsigned char>(v));
  }
  return seen;
}

cv::Mat VirtualCamera::background(const Pose& X_CW, const cv::Rect& region) const {
  if (!wall_.empty()) return wall_(region).clone();
  const picture::RayToPlane table = picture::rayToPlane(X_CW);
  const Mat3 H = table.height > 0 ? table.H : Mat3(Mat3::Zero());
  return lookUp(textures_.nearest(X_CW, truth_.fx), H, region);
}

/// Light, then noise, on this region: each row of each frame reads the bank from its own place, one
/// of two signs.
void VirtualCamera::expose(std::uint64_t frame_number, const cv::Rect& region,
                           cv::Mat* picture) const {
  const std::uint64_t frame =
      picture::randomBits(picture::randomBits(seed_, kRowStream), frame_number);
  const std::size_t width = std::size_t(truth_.width);
  for (int v = region.y; v < region.br().y; ++v) {
    const std::uint64_t draw = picture::randomBits(frame, std::uint64_t(v));
    const std::int16_t* noise = noise_.data() + (draw >> 8) % (kBank - width);
    const int sign = (draw & 1U) ? 1 : -1;
    exposeRow(gain_.ptr<std::uint16_t>(v) + region.x, noise + region.x, sign,
              std::size_t(region.width), picture->ptr<unsigned char>(v) + region.x);
  }
}

void VirtualCamera::blur(cv::Mat* picture) const {
  if (settings_.blur_sigma_px <= 0) return;
  cv::Mat sharp = *picture;  // of its own: in place the blur would copy it
  *picture = cv::Mat();
  cv::GaussianBlur(sharp, *picture, {0, 0}, settings_.blur_sigma_px);
}

cv::Mat VirtualCamera::render(const Pose& X_CW_true, std::uint64_t frame_number) const {
  return render(X_CW_true, frame_number, whole());
}

cv::Mat VirtualCamera::render(const Pose& X_CW_true, std::uint64_t frame_number,
                              const cv::Rect& part) const {
  const cv::Rect looked_at = part & whole(), region = looked_at.empty() ? whole() : looked_at;
  const int reach = int(std::ceil(4 * settings_.blur_sigma_px)) + 1;  // of the blur, on either side
  const cv::Rect drawn =
      cv::Rect(region.tl() - cv::Point(reach, reach), region.br() + cv::Point(reach, reach)) &
      whole();
  cv::Mat seen = background(X_CW_true, drawn);
  blur(&seen);
  cv::Mat picture = seen;
  if (region != whole()) {
    picture = cv::Mat(whole().size(), CV_8U, cv::Scalar(0));
    seen(region - drawn.tl()).copyTo(picture(region));
  }
  expose(frame_number, region, &picture);
  return picture;
}

}  // namespace palpa::twin
