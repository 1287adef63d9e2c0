#include "anatomy/volume/ct_patient.h"

#include <algorithm>
#include <cmath>

namespace palpa::anatomy {
namespace {

constexpr double kPixel = 1e-3;
constexpr int kCross = 5;
constexpr std::array<std::array<std::uint8_t, 3>, 6> kColours{{{90, 150, 255},
                                                               {120, 255, 120},
                                                               {255, 190, 60},
                                                               {255, 110, 160},
                                                               {80, 230, 230},
                                                               {220, 220, 90}}};

/// One view: which axes run right and down, and whether down is against the axis.
struct SliceAxes {
  std::size_t right, down, through;
  bool against;
};
constexpr std::array<SliceAxes, 3> kViews{{{0, 2, 1, true}, {1, 2, 0, true}, {0, 1, 2, false}}};

class Panel {
 public:
  Panel(const Scan& scan, const SliceAxes& view) : scan_(scan), view_(view) {
    const VoxelGrid& grid = scan.grid;
    columns_ = grid.size[view.right], rows_ = grid.size[view.down];
    width_ = std::max(
        1, static_cast<int>(columns_ * grid.spacing[static_cast<int>(view.right)] / kPixel));
    height_ =
        std::max(1, static_cast<int>(rows_ * grid.spacing[static_cast<int>(view.down)] / kPixel));
  }
  int width() const { return width_; }
  int height() const { return height_; }

  void draw(const std::vector<const LabelledOrgan*>& labels, const Seeds& marks, int left,
            RgbPicture* picture) const {
    std::vector<float> brightest(
        static_cast<std::size_t>(columns_) * static_cast<std::size_t>(rows_), 0);
    const double low = scan_.levels.clipped ? 0 : -100, high = 1.2 * scan_.levels.dense;
    for (std::size_t n = 0; n < scan_.body.size(); ++n)
      if (scan_.body[n]) {
        float& b = brightest[flat(scan_.grid.cell(n))];
        b = std::max(b, static_cast<float>(
                            std::clamp((scan_.volume.values[n] - low) / (high - low), 0.0, 1.0)));
      }
    forPixels([&](int x, int y, std::size_t at) {
      const auto gray = static_cast<std::uint8_t>(200 * std::sqrt(brightest[at]));
      put(picture, left + x, y, {gray, gray, gray});
    });
    for (std::size_t i = 0; i < labels.size(); ++i)
      outline(labels[i]->mask, kColours[i % kColours.size()], left, picture);
    for (const auto& [key, p] : marks) cross(p, left, picture);
  }

 private:
  std::size_t flat(const Index3& c) const {
    const int row = view_.against ? rows_ - 1 - c[view_.down] : c[view_.down];
    return static_cast<std::size_t>(row) * static_cast<std::size_t>(columns_) +
           static_cast<std::size_t>(c[view_.right]);
  }

  template <class Visit>
  void forPixels(Visit visit) const {
    for (int y = 0; y < height_; ++y)
      for (int x = 0; x < width_; ++x)
        visit(x, y,
              static_cast<std::size_t>(y * rows_ / height_) * static_cast<std::size_t>(columns_) +
                  static_cast<std::size_t>(x * columns_ / width_));
  }

  static void put(RgbPicture* picture, int x, int y, const std::array<std::uint8_t, 3>& colour) {
    if (x < 0 || y < 0 || x >= picture->width || y >= picture->height) return;
    std::copy(colour.begin(), colour.end(),
              picture->rgb.begin() + 3 * (static_cast<std::ptrdiff_t>(y) * picture->width + x));
  }

  void outline(const Mask& mask, const std::array<std::uint8_t, 3>& colour, int left,
               RgbPicture* picture) const {
    std::vector<std::uint8_t> shadow(
        static_cast<std::size_t>(columns_) * static_cast<std::size_t>(rows_), 0);
    for (std::size_t n = 0; n < mask.size(); ++n)
      if (mask[n]) shadow[flat(scan_.grid.cell(n))] = 1;
    const auto in = [&](int x, int y) {
      return x >= 0 && y >= 0 && x < width_ && y < height_ &&
             shadow[static_cast<std::size_t>(y * rows_ / height_) *
                        static_cast<std::size_t>(columns_) +
                    static_cast<std::size_t>(x * columns_ / width_)];
    };
    forPixels([&](int x, int y, std::size_t) {
      if (in(x, y) && !(in(x - 1, y) && in(x + 1, y) && in(x, y - 1) && in(x, y + 1)))
        put(picture, left + x, y, colour);
    });
  }

  void cross(const Vec3& p_S, int left, RgbPicture* picture) const {
    const Index3 c = scan_.cellAt(p_S);
    const int row = view_.against ? rows_ - 1 - c[view_.down] : c[view_.down];
    const int x = left + c[view_.right] * width_ / columns_, y = row * height_ / rows_;
    for (int d = -kCross; d <= kCross; ++d)
      put(picture, x + d, y, {255, 60, 60}), put(picture, x, y + d, {255, 60, 60});
  }

  const Scan& scan_;
  SliceAxes view_;
  int columns_, rows_, width_, height_;
};

}  // namespace

RgbPicture projections(const Scan& scan, const std::vector<const LabelledOrgan*>& labels,
                       const Seeds& marks) {
  std::vector<Panel> panels;
  RgbPicture picture;
  for (const SliceAxes& view : kViews) {
    panels.emplace_back(scan, view);
    picture.width += panels.back().width() + 4;
    picture.height = std::max(picture.height, panels.back().height());
  }
  picture.rgb.assign(
      static_cast<std::size_t>(picture.width) * static_cast<std::size_t>(picture.height) * 3, 0);
  int left = 0;
  for (const Panel& panel : panels)
    panel.draw(labels, marks, left, &picture), left += panel.width() + 4;
  return picture;
}

}  // namespace palpa::anatomy
