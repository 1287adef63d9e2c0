#include "ar/boards/tag_grid.h"

#include <algorithm>
#include <cmath>
#include <sstream>

#include "anatomy/base/error.h"

namespace palpa::ar {
namespace {

double pitch(const TagGridSpec& spec) { return spec.tag_size + spec.spacing; }

std::array<Vec3, 4> cornersAround(double x, double y, double tag_size) {
  const double h = tag_size / 2;
  return {Vec3(x - h, y - h, 0), Vec3(x + h, y - h, 0), Vec3(x + h, y + h, 0),
          Vec3(x - h, y + h, 0)};
}

void append(const Tag& tag, const std::array<Vec3, 4>& corners, std::vector<BoardPoint>* points) {
  for (std::size_t i = 0; i < 4; ++i) points->push_back({corners[i], tag.corners[i]});
}

/// Twice the area of the tag's outline in square pixels.
double area2(const Tag& tag) {
  const Eigen::Vector2d a = tag.corners[2] - tag.corners[0], b = tag.corners[3] - tag.corners[1];
  return std::abs(a.x() * b.y() - a.y() * b.x());
}

void require(bool good, const std::string& what, const std::string& where) {
  if (!good)
    throw UsageError(what, where, "A grid that works: 6 x 4 tags of 0.030 m, 0.0075 m apart.");
}

}  // namespace

void validate(const TagGridSpec& spec, const std::string& where) {
  const auto count = [](int n) { return n >= 1 && n <= kTagFamilySize; };
  require(count(spec.columns) && count(spec.rows), "columns and rows must be at least 1", where);
  require(spec.tag_size >= 0.002 && spec.tag_size <= 2.0, "tag_size must be 0.002 to 2 m", where);
  require(spec.border_bits == 1 || spec.border_bits == 2, "border_bits must be 1 or 2", where);
  const double cell = spec.tag_size / (6 + 2 * spec.border_bits);  // 6 x 6 bits and the border
  require(spec.spacing >= cell * (1 - 1e-9) && spec.spacing <= 2.0,
          "spacing must be at least a cell of the tag: the white round each tag", where);
  require(spec.first_id >= 0 && spec.first_id + spec.columns * spec.rows <= kTagFamilySize,
          "ids must lie within tag36h11, 0 to 586", where);
  require(!spec.corner_squares || spec.columns * spec.rows >= 2,
          "an AprilGrid must have at least two tags", where);
}

Eigen::Vector2d sheetSize(const TagGridSpec& spec) {
  return Eigen::Vector2d(spec.columns, spec.rows) * pitch(spec) +
         Eigen::Vector2d::Constant(spec.corner_squares ? 3 * spec.spacing : spec.spacing);
}

std::array<Vec3, 4> tagCorners(const TagGridSpec& spec, int id) {
  const int index = id - spec.first_id, column = index % spec.columns, row = index / spec.columns;
  return cornersAround((column - (spec.columns - 1) / 2.0) * pitch(spec),
                       (row - (spec.rows - 1) / 2.0) * pitch(spec), spec.tag_size);
}

TagGridBoard::TagGridBoard(const TagGridSpec& spec, double decimate)
    : spec_(spec), detector_(boardTagSettings(decimate, spec.border_bits)) {
  validate(spec, "tag grid");
}

std::vector<BoardPoint> TagGridBoard::detect(const cv::Mat& image) const {
  const std::vector<Tag> tags = detector_.detect(image);  // sorted by id
  const auto same = [&](std::size_t i, std::size_t j) {
    return j < tags.size() && tags[i].id == tags[j].id;
  };
  std::vector<BoardPoint> points;
  for (std::size_t i = 0; i < tags.size(); ++i) {
    const int index = tags[i].id - spec_.first_id;
    const bool ours = index >= 0 && index < spec_.columns * spec_.rows;
    const bool twice = same(i, i + 1) || (i > 0 && same(i, i - 1));
    if (ours && !twice) append(tags[i], tagCorners(spec_, tags[i].id), &points);
  }
  return points;
}

std::string TagGridBoard::describe() const {
  std::ostringstream text;
  text << spec_.columns << " x " << spec_.rows << " tag36h11 of " << spec_.tag_size * 1000
       << " mm, " << spec_.spacing * 1000 << " mm apart, ids from " << spec_.first_id;
  if (spec_.border_bits != 1) text << ", border of " << spec_.border_bits << " cells";
  return text.str();
}

SingleTagBoard::SingleTagBoard(double tag_size, double decimate)
    : tag_size_(tag_size), detector_(boardTagSettings(decimate, 1)) {
  require(tag_size >= 0.002 && tag_size <= 2.0, "tag_size must be 0.002 to 2 m", "single tag");
}

std::vector<BoardPoint> SingleTagBoard::detect(const cv::Mat& image) const {
  const std::vector<Tag> tags = detector_.detect(image);
  const auto largest = std::max_element(
      tags.begin(), tags.end(), [](const Tag& a, const Tag& b) { return area2(a) < area2(b); });
  std::vector<BoardPoint> points;
  if (largest != tags.end()) append(*largest, cornersAround(0, 0, tag_size_), &points);
  return points;
}

std::string SingleTagBoard::describe() const {
  std::ostringstream text;
  text << "single tag36h11 of " << tag_size_ * 1000 << " mm";
  return text.str();
}

}  // namespace palpa::ar
