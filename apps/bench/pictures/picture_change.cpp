#include "apps/bench/pictures/picture_change.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <opencv2/imgproc.hpp>

namespace palpa::bench {
namespace {

using Eigen::Vector2d;
constexpr float kLeastShade = 0.02f, kDarkest = 0.72f;  // what is darker is a thing
constexpr float kOneColour = 0.10f;                     // a shadow takes as much from every channel
constexpr float kPink = 0.16f;

cv::Mat3f softened(const cv::Mat3b& picture) {
  cv::Mat3f soft;
  picture.convertTo(soft, CV_32F);
  cv::GaussianBlur(soft, soft, {}, 0.6);
  return soft;
}

cv::Vec3f between(const cv::Mat3f& picture, const Vector2d& p) {
  const int u = std::clamp(int(std::floor(p.x())), 0, picture.cols - 2),
            v = std::clamp(int(std::floor(p.y())), 0, picture.rows - 2);
  const auto x = float(std::clamp(p.x() - u, 0.0, 1.0)), y = float(std::clamp(p.y() - v, 0.0, 1.0));
  return (1 - y) * ((1 - x) * picture(v, u) + x * picture(v, u + 1)) +
         y * ((1 - x) * picture(v + 1, u) + x * picture(v + 1, u + 1));
}

float pinkness(const cv::Vec3f& rgb) {
  return (std::min(rgb[0], 1.15f * rgb[2]) - rgb[1]) / (brightness(rgb) + 10);
}

float largest(const cv::Vec3f& change) {
  return std::max({std::abs(change[0]), std::abs(change[1]), std::abs(change[2])});
}

template <class Is>
cv::Mat1b where(const cv::Size& size, const Is& is) {
  cv::Mat1b mask(size, uchar(0));
  for (int v = 0; v < mask.rows; ++v)
    for (int u = 0; u < mask.cols; ++u) mask(v, u) = is(u, v) ? 255 : 0;
  return mask;
}

/// From a to b.
cv::Mat1f shadeOf(const cv::Mat3f& a, const cv::Mat3f& b) {
  cv::Mat1f shade(a.size(), 0.f);
  for (int v = 0; v < a.rows; ++v)
    for (int u = 0; u < a.cols; ++u) {
      std::array<float, 3> lost{};
      for (int k = 0; k < 3; ++k) lost[std::size_t(k)] = 1 - (b(v, u)[k] + 1) / (a(v, u)[k] + 1);
      const auto [low, high] = std::minmax_element(lost.begin(), lost.end());
      if (*low > kLeastShade && *high < kDarkest && *high - *low < kOneColour)
        shade(v, u) = (lost[0] + lost[1] + lost[2]) / 3;
    }
  return shade;
}

/// What is as dark and as broad is a syringe: only a needle's shadow is dark, near its tip, and it
/// is thin.
void forgetBroadAndDark(cv::Mat1f* shade) {
  constexpr float kDark = 0.4f;
  constexpr int kBroad_px = 9;
  cv::Mat1b broad;
  cv::morphologyEx(*shade > kDark, broad, cv::MORPH_OPEN, cv::Mat1b::ones(kBroad_px, kBroad_px));
  shade->setTo(0, broad);
}

}  // namespace

float brightness(const cv::Vec3f& rgb) { return (rgb[0] + rgb[1] + rgb[2]) / 3; }

PictureChange::PictureChange(const cv::Mat3b& before, const cv::Mat3b& now)
    : before_(softened(before)), now_(softened(now)), shade_(shadeOf(before_, now_)) {
  forgetBroadAndDark(&shade_);
}

cv::Vec3f PictureChange::now(const Vector2d& p) const { return between(now_, p); }
cv::Vec3f PictureChange::at(const Vector2d& p) const {
  return between(now_, p) - between(before_, p);
}
float PictureChange::size(const Vector2d& p) const { return largest(at(p)); }
float PictureChange::lighter(const Vector2d& p) const { return brightness(at(p)); }
float PictureChange::pinker(const Vector2d& p) const {
  return pinkness(between(now_, p)) - pinkness(between(before_, p));
}
bool PictureChange::inside(const Vector2d& p) const {
  return p.x() > 1 && p.y() > 1 && p.x() < now_.cols - 2 && p.y() < now_.rows - 2;
}

cv::Mat1b PictureChange::pink() const {
  return where(now_.size(), [&](int u, int v) {
    return pinkness(now_(v, u)) - pinkness(before_(v, u)) > kPink;
  });
}
cv::Mat1b PictureChange::thing() const {
  return where(now_.size(), [&](int u, int v) {
    return shade_(v, u) <= 0 && largest(now_(v, u) - before_(v, u)) > kChanged;
  });
}

}  // namespace palpa::bench
