#include "ar/cameras/picture_look.h"

#include <opencv2/imgproc.hpp>

#include "anatomy/base/error.h"
#include "anatomy/base/quantile.h"
#include "ar/cameras/picture_edges.h"
#include "ar/cameras/picture_grain.h"

namespace palpa::ar {
namespace {

constexpr std::size_t kFewestEdges = 12;

}  // namespace

std::optional<PictureLook> lookOf(const cv::Mat& picture, const cv::Rect& where) {
  if (picture.empty() || (picture.type() != CV_8UC1 && picture.type() != CV_8UC3))
    throw Error("the picture is neither 8-bit gray nor BGR", "the camera's look",
                "Convert the picture first");
  cv::Mat gray = picture;
  if (picture.channels() == 3) cv::cvtColor(picture, gray, cv::COLOR_BGR2GRAY);
  const cv::Rect all(0, 0, picture.cols, picture.rows);
  ClearEdges edges = clearEdges(picture, gray, where.empty() ? all : where);
  if (edges.sigma.size() < kFewestEdges && !where.empty()) edges = clearEdges(picture, gray, all);
  if (edges.sigma.size() < kFewestEdges) return std::nullopt;
  const std::optional<Grain> grain = grainOf(picture, gray);
  if (!grain) return std::nullopt;
  PictureLook look;
  look.blur_px = edges.blur_px();
  double bright = 0, dark = 0;
  for (std::size_t k = 0; k < 3; ++k) {
    const double white = quantile(edges.bright[k], 0.75), black = quantile(edges.dark[k], 0.25);
    look.white[k] = white / 255;
    look.black[k] = black / 255;
    bright += white / 3;
    dark += black / 3;
  }
  for (std::size_t k = 0; k < look.grain.size(); ++k) {
    const double way = static_cast<double>(k) / (look.grain.size() - 1);
    look.grain[k] = grain->sigmaAt(dark + way * (bright - dark)) / 255;
  }
  look.grain_neighbours = grain->neighbours;
  look.grain_colour = grain->colour;
  return look;
}

}  // namespace palpa::ar
