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

struct SheetMaker {
  Sheet operator()(const TagGridSpec& spec) const { return sheetOf(spec); }
  Sheet operator()(const ChessboardSpec& spec) const {
    return chessboardSheet(spec.inner_corners, spec.square);
  }
  Sheet operator()(const SingleTagSpec& spec) const {
    return sheetOf(TagGridSpec{1, 1, spec.tag_size, spec.tag_size / 4, 0});
  }
  Sheet operator()(const CharucoSpec& spec) const { return sheetOf(spec); }
};

}  // namespace

std::unique_ptr<Board> makeBoard(const TagGridSpec& spec, double decimate) {
  return Maker{decimate}(spec);
}

std::unique_ptr<Board> makeBoard(const std::string& spec, double decimate) {
  return std::visit(Maker{decimate}, parseBoardSpec(spec));
}

Sheet sheetOf(const std::string& spec) { return std::visit(SheetMaker{}, parseBoardSpec(spec)); }

cv::Mat drawBoard(const std::string& spec, double px_per_m) {
  return pictureOf(sheetOf(spec), px_per_m);
}

}  // namespace palpa::ar
