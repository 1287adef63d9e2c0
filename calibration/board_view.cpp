#include "calibration/camera_calibration.h"

#include <algorithm>
#include <cmath>

#include "anatomy/base/error.h"
#include "anatomy/geometry/dense_solvers.h"

namespace palpa::calibration {
namespace {

constexpr std::size_t kLeastCorners = 8;
constexpr double kLine = 1e-4;       // of the variance along it
constexpr double kSamePlace = 1e-6;  // m

void requireCorners(const BoardView& view, const std::string& where) {
  const std::string name = "the view " + view.name;
  if (view.pixels.size() != view.p_W.size())
    throw Error(name + " has " + std::to_string(view.pixels.size()) +
                    " corners in the picture and " + std::to_string(view.p_W.size()) +
                    " on the board",
                where, "Give each corner once in both, in the same order");
  if (view.pixels.size() < kLeastCorners)
    throw Error(
        name + " shows " + std::to_string(view.pixels.size()) + " corners, which is too few", where,
        "Leave it out");
  for (std::size_t i = 0; i < view.pixels.size(); ++i) {
    if (!view.pixels[i].allFinite() || !view.p_W[i].allFinite())
      throw Error("a corner of " + name + " is not a number", where, "Leave the corner out");
    if (std::abs(view.p_W[i].z()) > kSamePlace)
      throw Error("the board of " + name + " is not flat", where,
                  "Give its corners with z = 0; lengths are metres");
  }
}

template <class Points>
bool onOneLine(const Points& points) {
  Eigen::Vector2d mean = Eigen::Vector2d::Zero();
  for (const auto& p : points) mean += p.template head<2>() / static_cast<double>(points.size());
  Eigen::Matrix2d spread = Eigen::Matrix2d::Zero();
  for (const auto& p : points)
    spread += (p.template head<2>() - mean) * (p.template head<2>() - mean).transpose();
  const Eigen::Vector2d sizes = symmetricEigen(spread).values;
  return !(sizes[0] > kLine * sizes[1]);
}

bool has(const std::vector<Vec3>& board, const Vec3& p) {
  return std::any_of(board.begin(), board.end(), [&](const Vec3& q) {
    return (p - q).squaredNorm() < kSamePlace * kSamePlace;
  });
}

/// The board grows from the fullest view by every view of which half the corners are known; what is
/// left over is of another one.
void requireOneBoard(const std::vector<BoardView>& views, const std::string& where) {
  std::vector<const BoardView*> left;
  for (const BoardView& view : views) left.push_back(&view);
  std::stable_sort(left.begin(), left.end(), [](const BoardView* a, const BoardView* b) {
    return a->p_W.size() > b->p_W.size();
  });
  const std::string fullest = left.front()->name;
  std::vector<Vec3> board = left.front()->p_W;
  const auto join = [&](const BoardView* view) {
    std::vector<Vec3> unknown;
    for (const Vec3& p : view->p_W)
      if (!has(board, p)) unknown.push_back(p);
    if (2 * unknown.size() > view->p_W.size()) return false;
    board.insert(board.end(), unknown.begin(), unknown.end());
    return true;
  };
  while (std::erase_if(left, join) > 0) {
  }
  if (!left.empty())
    throw Error(
        "the views " + fullest + " and " + left.front()->name + " are of boards that differ", where,
        "Use pictures of one board, with one size of squares");
}

}  // namespace

void requireBoardViews(const std::vector<BoardView>& views, const std::string& where) {
  for (const BoardView& view : views) {
    requireCorners(view, where);
    if (onOneLine(view.pixels) || onOneLine(view.p_W))
      throw Error("the corners of the view " + view.name + " lie on one line", where,
                  "Leave it out");
  }
  if (!views.empty()) requireOneBoard(views, where);
}

}  // namespace palpa::calibration
