#include <algorithm>
#include <cmath>
#include <limits>
#include <string>

#include "anatomy/base/error.h"
#include "apps/twin/virtual_camera.h"
#include "apps/twin/virtual_camera_picture.h"

/// The virtual camera's free plates. A plane's nearness, one over its depth Z in C, is linear in
/// the ray (x, y, 1), and so is w times the distance from a straight edge on it
/// (picture::RayToPlane): in the picture without distortion that is the distance from the edge's
/// line.
namespace palpa::twin {
namespace {

using picture::RayToPlane;

constexpr double kEdgeOn = 1e-6;     // metres: nearer to its plane a camera sees nothing of a plate
constexpr double kOnTable = 1e-4;    // share of the depth that a plate may be below the table
constexpr double kNearestZ = 1e-4;   // metres: from here on corners have a place in the picture
constexpr double kRoomInPixels = 2;  // a pixel beyond the edge takes part, and lenses stretch

/// Distances from the sheet's four edges, positive inside, in pixels near the picture's centre:
/// rows that multiply (x, y, 1). Right where they matter, on the edge: elsewhere, and where the
/// lens stretches the picture, only the width of the ramp across the edge differs, not its middle.
Eigen::Matrix<float, 4, 3> edges(const RayToPlane& plane, const Eigen::Vector2d& size, double fx,
                                 double fy) {
  Eigen::Matrix<double, 4, 3> rows;
  for (int axis = 0; axis < 2; ++axis) {
    rows.row(2 * axis) = size[axis] / 2 * plane.H.row(2) - plane.H.row(axis);
    rows.row(2 * axis + 1) = size[axis] / 2 * plane.H.row(2) + plane.H.row(axis);
  }
  for (int i = 0; i < 4; ++i)
    rows.row(i) /= std::max(std::hypot(rows(i, 0) / fx, rows(i, 1) / fy), 1e-12);
  return rows.cast<float>();
}

/// Of a pixel between two edges at these distances.
float shareBetween(float a, float b) {
  const float sum = std::min(std::max(a + 0.5F, 0.F), 1.F) + std::min(std::max(b + 0.5F, 0.F), 1.F);
  return std::max(sum - 1, 0.F);
}

/// Multiplies (x, y, 1) to one over the depth.
Vec3 nearnessOf(const RayToPlane& plane) {
  return plane.H.row(2).transpose() / std::max(std::abs(plane.height), kEdgeOn);
}

struct Fragment {
  float nearness, share;
  unsigned char gray;
};

/// Nearest first, all before what lies behind them.
unsigned char blend(const std::vector<Fragment>& fragments, unsigned char behind) {
  float left = 1, sum = 0;
  for (const Fragment& fragment : fragments) {
    sum += left * fragment.share * float(fragment.gray);
    left *= 1 - fragment.share;
  }
  return static_cast<unsigned char>(sum + left * float(behind) + 0.5F);
}

}  // namespace

/// One plate as it would be seen alone.
struct VirtualCamera::Layer {
  cv::Rect region;
  cv::Mat gray;             ///< of the plane, 8 bits
  cv::Mat share, nearness;  ///< float: of each pixel that the sheet covers; one over its depth
};

/// In the picture without distortion a sheet lies within the box round its corners.
cv::Rect VirtualCamera::regionOf(const Plate& plate, const Pose& X_CB) const {
  const Eigen::Vector2d room = kRoomInPixels * Eigen::Vector2d(1 / truth_.fx, 1 / truth_.fy);
  Eigen::Vector2d low = Eigen::Vector2d::Constant(std::numeric_limits<double>::max()), high = -low;
  int behind = 0;
  for (const double sx : {-0.5, 0.5})
    for (const double sy : {-0.5, 0.5}) {
      const Vec3 p_C = X_CB * Vec3(sx * plate.size.x(), sy * plate.size.y(), 0);
      if (p_C.z() < kNearestZ) {
        ++behind;
        continue;
      }
      low = low.cwiseMin(p_C.head<2>() / p_C.z() - room);
      high = high.cwiseMax(p_C.head<2>() / p_C.z() + room);
    }
  if (behind == 4) return {};
  if (behind > 0) return {0, 0, ray_x_.cols, ray_x_.rows};
  cv::Rect region;
  for (const picture::RayBlock& block : blocks_)
    if ((block.low.array() <= high.array()).all() && (block.high.array() >= low.array()).all())
      region = region.empty() ? block.pixels : region | block.pixels;
  return region;
}

VirtualCamera::Layer VirtualCamera::layerOf(const PlatePose& placed) const {
  const Plate& plate = plates_[placed.plate];
  const RayToPlane plane = picture::rayToPlane(placed.X_CB);
  Layer layer;
  layer.region = regionOf(plate, placed.X_CB);
  if (std::abs(plane.height) < kEdgeOn) layer.region = {};
  if (layer.region.empty()) return layer;
  layer.gray = plane.height > 0
                   ? lookUp(plate.textures.nearest(placed.X_CB, truth_.fx), plane.H, layer.region)
                   : cv::Mat(layer.region.size(), CV_8U, cv::Scalar(picture::kPaper));
  layer.share.create(layer.region.size(), CV_32F);
  layer.nearness.create(layer.region.size(), CV_32F);
  const Eigen::Matrix<float, 4, 3> E = edges(plane, plate.size, truth_.fx, truth_.fy);
  const Eigen::Vector3f n = nearnessOf(plane).cast<float>();
  for (int v = 0; v < layer.region.height; ++v) {
    const float* x = ray_x_.ptr<float>(layer.region.y + v) + layer.region.x;
    const float* y = ray_y_.ptr<float>(layer.region.y + v) + layer.region.x;
    float *share = layer.share.ptr<float>(v), *nearness = layer.nearness.ptr<float>(v);
    for (int u = 0; u < layer.region.width; ++u) {
      const auto distance = [&](int i) { return E(i, 0) * x[u] + E(i, 1) * y[u] + E(i, 2); };
      nearness[u] = n[0] * x[u] + n[1] * y[u] + n[2];
      const float covered =
          shareBetween(distance(0), distance(1)) * shareBetween(distance(2), distance(3));
      share[u] = nearness[u] > 0 ? covered : 0.F;
    }
  }
  return layer;
}

/// Each layer does the pixels of its region that no layer before it has done, for all.
void VirtualCamera::compose(const std::vector<Layer>& layers, const Vec3& table_nearness,
                            cv::Mat* picture) const {
  const Eigen::Vector3f t = ((1 - kOnTable) * table_nearness).cast<float>();
  std::vector<Fragment> fragments;
  const auto add = [&](const Layer& layer, const cv::Point& pixel, float table) {
    const cv::Point at = pixel - layer.region.tl();
    const Fragment fragment{layer.nearness.at<float>(at), layer.share.at<float>(at),
                            layer.gray.at<unsigned char>(at)};
    if (fragment.share <= 0 || fragment.nearness < table) return;
    const auto farther = [&](const Fragment& f) { return f.nearness < fragment.nearness; };
    fragments.insert(std::find_if(fragments.begin(), fragments.end(), farther), fragment);
  };
  for (auto layer = layers.begin(); layer != layers.end(); ++layer)
    for (int v = layer->region.y; v < layer->region.br().y; ++v)
      for (int u = layer->region.x; u < layer->region.br().x; ++u) {
        const cv::Point pixel(u, v);
        const auto has = [&](const Layer& other) { return other.region.contains(pixel); };
        if (std::any_of(layers.begin(), layer, has)) continue;
        const float table = t[0] * ray_x_.at<float>(pixel) + t[1] * ray_y_.at<float>(pixel) + t[2];
        fragments.clear();
        for (auto other = layer; other != layers.end(); ++other)
          if (has(*other)) add(*other, pixel, table);
        if (fragments.empty()) continue;
        unsigned char& gray = picture->at<unsigned char>(pixel);
        gray = blend(fragments, gray);
      }
}

cv::Mat VirtualCamera::render(const Pose& X_CW_true, std::span<const PlatePose> plates,
                              std::uint64_t frame_number) const {
  std::vector<Layer> layers;
  for (const PlatePose& placed : plates) {
    if (placed.plate >= plates_.size() || !placed.X_CB.matrix().allFinite())
      throw UsageError("plate " + std::to_string(placed.plate) +
                           " has no finite pose or there are only " +
                           std::to_string(plates_.size()) + " plates",
                       "virtual camera", "Name the plates of its scene.");
    layers.push_back(layerOf(placed));
  }
  cv::Mat picture = background(X_CW_true, whole());
  Vec3 table = Vec3::Zero();  // infinitely far
  if (wall_.empty()) table = nearnessOf(picture::rayToPlane(X_CW_true));
  compose(layers, table, &picture);
  blur(&picture);
  expose(frame_number, whole(), &picture);
  return picture;
}

}  // namespace palpa::twin
