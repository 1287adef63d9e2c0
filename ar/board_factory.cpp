#include "anatomy/geometry/error.h"
#include "ar/april_grid.h"
#include "ar/board_spec.h"
#include "ar/chessboard.h"
#include "ar/tag_grid.h"

namespace palpa::ar {
namespace {

struct Maker {
  double decimate;

  std::unique_ptr<Board> operator()(const TagGridSpec& spec) const {
    if (spec.corner_squares) return std::make_unique<AprilGridBoard>(spec);
    return std::make_unique<TagGridBoard>(spec, decimate);
  }
  std::unique_ptr<Board> operator()(const ChessboardSpec& spec) const {
    return std::make_unique<Chessboard>(spec.inner_corners, spec.square, spec.half_window_px);
  }
  std::unique_ptr<Board> operator()(const SingleTagSpec& spec) const {
    return std::make_unique<SingleTagBoard>(spec.tag_size, decimate);
  }
  std::unique_ptr<Board> operator()(const CharucoSpec& spec) const {
    return std::make_unique<CharucoBoard>(spec);
  }
};

struct Drawer {
  double px_per_m;

  cv::Mat operator()(const TagGridSpec& spec) const { return drawTagGrid(spec, px_per_m); }
  cv::Mat operator()(const ChessboardSpec& spec) const {
    return drawChessboard(spec.inner_corners, spec.square, px_per_m);
  }
  cv::Mat operator()(const SingleTagSpec& spec) const {
    return drawTagGrid({1, 1, spec.tag_size, spec.tag_size / 4, 0}, px_per_m);
  }
  cv::Mat operator()(const CharucoSpec& spec) const { return drawCharuco(spec, px_per_m); }
};

}  // namespace

std::unique_ptr<Board> makeBoard(const TagGridSpec& spec, double decimate) {
  return Maker{decimate}(spec);
}

std::unique_ptr<Board> makeBoard(const std::string& spec, double decimate) {
  return std::visit(Maker{decimate}, parseBoardSpec(spec));
}

cv::Mat drawBoard(const std::string& spec, double px_per_m) {
  return std::visit(Drawer{px_per_m}, parseBoardSpec(spec));
}

}  // namespace palpa::ar
