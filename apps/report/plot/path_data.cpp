#include "apps/report/plot/path_data.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>

namespace palpa::report {
namespace {

constexpr std::size_t kLongest = 256;  // points, so that each is soon done

/// 12.3, -.5, 7; with a space before it where it would run into the one before.
std::string number(long tenths, bool first) {
  std::string text = tenths < 0 ? "-" : first ? "" : " ";
  const long size = std::labs(tenths);
  if (size >= 10 || size == 0) text += std::to_string(size / 10);
  if (size % 10 != 0) text += '.' + std::to_string(size % 10);
  return text;
}

}  // namespace

PathData::Point PathData::rounded(double x, double y) {
  const auto tenths = [](double px) { return std::isfinite(px) ? std::lround(10 * px) : 0; };
  return {tenths(x), tenths(y)};
}

void PathData::moveTo(double x, double y) {
  write();
  at_ = rounded(x, y);
  d_ += 'M' + number(at_.x, true) + number(at_.y, false);
  drawing_ = true;
  stepping_ = false;
}

/// All that was passed lies on the line from the last that is written to `to`, and between them.
bool PathData::liesOnTheWayTo(const Point& to) const {
  const double dx = static_cast<double>(to.x - at_.x), dy = static_cast<double>(to.y - at_.y);
  const double length = std::hypot(dx, dy);
  return length > 0 && std::all_of(passed_.begin(), passed_.end(), [&](const Point& p) {
           const double x = static_cast<double>(p.x - at_.x), y = static_cast<double>(p.y - at_.y);
           const double along = (x * dx + y * dy) / length;
           return along >= 0 && along <= length && std::abs(x * dy - y * dx) <= length;
         });
}

void PathData::lineTo(double x, double y) {
  if (!drawing_) return moveTo(x, y);
  const Point to = rounded(x, y);
  if (passed_.empty() && to == at_) return;
  if (passed_.size() >= kLongest || (!passed_.empty() && !liesOnTheWayTo(to))) write();
  passed_.push_back(to);
}

void PathData::write() {
  if (passed_.empty()) return;
  const Point to = passed_.back();
  passed_.clear();
  d_ += (stepping_ ? "" : "l") + number(to.x - at_.x, !stepping_) + number(to.y - at_.y, false);
  stepping_ = true;
  at_ = to;
}

void PathData::close() {
  write();
  d_ += 'Z';
  drawing_ = stepping_ = false;
}

std::string PathData::str() {
  write();
  return d_;
}

}  // namespace palpa::report
