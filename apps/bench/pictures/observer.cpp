#include "apps/bench/pictures/observer.h"

#include <Eigen/Dense>
#include <algorithm>
#include <array>
#include <cmath>

#include "apps/bench/pictures/tool_in_picture.h"

namespace palpa::bench {
namespace {

using Eigen::Vector2d;
constexpr float kUnseen = -1;
constexpr double kShadow = 0.025;       // the least shade of one
constexpr double kHiddenGap = 0.0015;   // m: where no shadow is seen beside a needle
constexpr double kHiddenDepth = 0.003;  // m: where nothing of a needle is seen to be inside
constexpr double kWidthNoise_px = 0.5, kLengthNoise = 0.0002;

Vec3 rayThrough(const scene::Pinhole& camera, const Vector2d& px) {
  return {(px.x() - camera.cx) / camera.fx, (px.y() - camera.cy) / camera.fy, 1};
}
Vector2d projected(const scene::Pinhole& camera, const Vec3& p_C) {
  return {camera.fx * p_C.x() / p_C.z() + camera.cx, camera.fy * p_C.y() / p_C.z() + camera.cy};
}

/// The tool's axis in space. Along a straight line the inverse of depth is linear in the picture:
/// 1/z = (1 - x) / z_tip + x / z_end, x from 0 at the tip to 1 where the hub begins.
class Axis {
 public:
  Axis(const ToolInPicture& tool, const Observer::Knows& knows) : tool_(tool), knows_(knows) {
    Vector2d inverse = Vector2d::Constant(meanInverseDepth());
    for (int i = 0; i < 15; ++i) inverse -= step(inverse);
    inverse_ = inverse;
  }

  Vec3 at(double s) const { return place(s, inverse_); }
  bool makesSense() const {
    return inverse_.allFinite() && inverse_.minCoeff() > 0.5 && inverse_.maxCoeff() < 20;
  }

 private:
  double meanInverseDepth() const {
    double sum = 0;
    for (const auto& width : tool_.barrel) sum += width.px;
    return sum / double(tool_.barrel.size()) / (2 * knows_.barrel_radius * knows_.camera.fx);
  }

  Vec3 place(double s, const Vector2d& inverse) const {
    const double x = (s - tool_.tip) / (tool_.needle_end - tool_.tip);
    return rayThrough(knows_.camera, tool_.at(s)) / ((1 - x) * inverse[0] + x * inverse[1]);
  }

  /// In units of their noise: the needle's length, then the barrel's widths.
  Eigen::VectorXd misfit(const Vector2d& inverse) const {
    Eigen::VectorXd out(Eigen::Index(tool_.barrel.size()) + 1);
    const Vec3 tip = place(tool_.tip, inverse), end = place(tool_.needle_end, inverse);
    const double too_long = (end - tip).norm() - knows_.needle_length;
    out[0] = too_long / kLengthNoise;
    Eigen::Index row = 1;
    for (const auto& width : tool_.barrel) {
      const Vec3 p = place(width.s, inverse);
      const Vec3 side = knows_.barrel_radius * (end - tip).cross(p).normalized();
      const double seen =
          (projected(knows_.camera, p + side) - projected(knows_.camera, p - side)).norm();
      out[row++] = (width.px - seen) / kWidthNoise_px / std::sqrt(8.0);  // neighbours err alike
    }
    return out;
  }

  Vector2d step(const Vector2d& inverse) const {
    const Eigen::VectorXd here = misfit(inverse);
    Eigen::MatrixXd J(here.size(), 2);
    for (int k = 0; k < 2; ++k) {
      Vector2d moved = inverse;
      const double small = 1e-5 * inverse[k];
      moved[k] += small;
      J.col(k) = (misfit(moved) - here) / small;
    }
    const Vector2d whole = (J.transpose() * J).ldlt().solve(J.transpose() * here);
    return whole * std::min(1.0, 0.2 * inverse.norm() / std::max(whole.norm(), 1e-12));
  }

  const ToolInPicture& tool_;
  const Observer::Knows& knows_;
  Vector2d inverse_;
};

/// Where the tool itself is, unseen.
cv::Mat1f shadowBeside(const ToolInPicture& tool, cv::Mat1f shade) {
  constexpr double kHalf_px = 5;
  const Vector2d across = tool.across();
  for (int v = 0; v < shade.rows; ++v)
    for (int u = 0; u < shade.cols; ++u) {
      const Vector2d off = Vector2d(u, v) - tool.hub_px;
      if (off.dot(tool.along) > tool.tip - kHalf_px && std::abs(off.dot(across)) < kHalf_px)
        shade(v, u) = kUnseen;
    }
  return shade;
}

/// How well a shadow of a needle lies where one with its tip so far off would be, if the skin fell
/// away from the needle at this rate: shade where the needle's is, none before its tip.
class ShadowFit {
 public:
  ShadowFit(const cv::Mat1f& shade, const scene::Pinhole& camera, const Vec3& tip, const Vec3& back,
            const Vec3& away)
      : shade_(shade), camera_(camera), tip_(tip), back_(back), away_(away) {}

  struct Place {
    double off = 0, rate = 0, score = 0;
  };
  Place best() const {
    Place best;
    for (double off = 0; off < 0.08; off += 0.00025)
      for (double rate = -0.05; rate <= 1.6; rate += 0.025)
        if (const double here = score(off, rate); here > best.score) best = {off, rate, here};
    return best;
  }

 private:
  /// Mean shade where the needle's shadow would be, and how clear of it the skin is before its tip.
  /// What the tool itself hides tells neither way.
  double score(double off, double rate) const {
    constexpr int kLeastSeen = 3;
    constexpr std::array kOn{0.001, 0.003, 0.005, 0.008, 0.011, 0.014, 0.017, 0.020};
    constexpr std::array kBefore{-0.0015, -0.003, -0.0045, -0.006, -0.0075, -0.009};
    double on = 0, clear = 0;
    int seen = 0;
    for (const double x : kOn)
      if (const float shade = shadeAt(x, off, rate); shade >= 0) on += shade, ++seen;
    if (seen < kLeastSeen) return 0;
    on /= seen;
    for (const double x : kBefore)
      if (const float shade = shadeAt(x, off, rate); shade >= 0) clear += 0.5 * on - shade;
    return on + clear / kBefore.size();
  }

  float shadeAt(double behind, double off, double rate) const {
    const double gap = off + rate * behind;
    if (gap < 0) return kUnseen;
    const Vec3 p = tip_ + behind * back_ + gap * away_;
    const Vector2d px = projected(camera_, p);
    const int u = int(std::lround(px.x())), v = int(std::lround(px.y()));
    if (p.z() <= 0 || u < 0 || v < 0 || u >= shade_.cols || v >= shade_.rows) return kUnseen;
    return shade_(v, u);
  }

  const cv::Mat1f& shade_;
  const scene::Pinhole& camera_;
  Vec3 tip_, back_, away_;
};

}  // namespace

std::optional<double> Observer::heightAboveSkin(const cv::Mat3b& before,
                                                const cv::Mat3b& now) const {
  const PictureChange change(before, now);
  const auto tool = toolIn(change);
  if (!tool) return std::nullopt;
  const Axis axis(*tool, knows_);
  if (!axis.makesSense()) return std::nullopt;
  const Vec3 tip = axis.at(tool->tip), back = (axis.at(tool->needle_end) - tip).normalized();
  const cv::Mat1f shade = shadowBeside(*tool, change.shade().clone());
  const ShadowFit fit(shade, knows_.camera, tip, back, knows_.down_C);
  const auto [off, rate, score] = fit.best();
  return score < kShadow ? kHiddenGap : off;
}

std::optional<double> Observer::depthBehindSkin(const cv::Mat3b& before,
                                                const cv::Mat3b& now) const {
  const auto tool = toolIn(PictureChange(before, now));
  if (!tool) return std::nullopt;
  const auto entry = tool->ring ? tool->ring : tool->tint;
  if (!entry) return kHiddenDepth;
  const Axis axis(*tool, knows_);
  if (!axis.makesSense()) return std::nullopt;
  return knows_.needle_length - (axis.at(tool->needle_end) - axis.at(*entry)).norm();
}

}  // namespace palpa::bench
