#include "apps/bench/pictures/tool_in_picture.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <opencv2/imgproc.hpp>

#include "anatomy/base/quantile.h"

namespace palpa::bench {
namespace {

using Eigen::Vector2d;
using Change = PictureChange;
constexpr float kChanged = Change::kChanged;
constexpr double kNeedleHalf_px = 5;                // half of its line's width, with dark edges
constexpr double kRingNear_px = 3.5, kRing_px = 9;  // from the line: where only a ring is

/// The part of a mask that this pixel belongs to, joined over gaps of some pixels.
cv::Mat1b partAt(const cv::Mat1b& mask, const cv::Mat1b& seed) {
  cv::Mat1b joined;
  cv::morphologyEx(mask | seed, joined, cv::MORPH_CLOSE, cv::Mat1b::ones(7, 7));
  cv::Mat1i label;
  const int labels = cv::connectedComponents(joined, label);
  std::vector<int> votes(std::size_t(labels), 0);
  for (int v = 0; v < mask.rows; ++v)
    for (int u = 0; u < mask.cols; ++u)
      if (seed(v, u)) ++votes[std::size_t(label(v, u))];
  votes[0] = 0;
  const auto most = int(std::max_element(votes.begin(), votes.end()) - votes.begin());
  return (label == most) & mask;
}

std::vector<cv::Point> pointsOf(const cv::Mat1b& mask) {
  std::vector<cv::Point> points;
  cv::findNonZero(mask, points);
  return points;
}

Vector2d meanOf(const std::vector<cv::Point>& points) {
  Vector2d sum = Vector2d::Zero();
  for (const cv::Point& p : points) sum += Vector2d(p.x, p.y);
  return sum / double(points.size());
}

/// The largest blob of pink.
cv::Mat1b hubOf(const cv::Mat1b& pink) {
  cv::Mat1b open;
  cv::morphologyEx(pink, open, cv::MORPH_CLOSE, cv::Mat1b::ones(3, 3));
  cv::Mat1i label;
  cv::Mat stats, middles;
  const int labels = cv::connectedComponentsWithStats(open, label, stats, middles);
  int best = 0, most = 0;
  for (int i = 1; i < labels; ++i)
    if (const int area = stats.at<int>(i, cv::CC_STAT_AREA); area > most) best = i, most = area;
  return best > 0 ? cv::Mat1b(label == best) : cv::Mat1b(pink.size(), uchar(0));
}

/// How sharply what has changed begins or ends across the line, a pixel; shadows have soft edges.
float edgeAt(const Change& change, const ToolInPicture& tool, double s, double x) {
  constexpr double kHalf = 0.75;
  constexpr float kEnough = 16;
  const Vector2d across = tool.across();
  const cv::Vec3f step =
      change.at(tool.at(s) + (x + kHalf) * across) - change.at(tool.at(s) + (x - kHalf) * across);
  return std::min(kEnough, std::max({std::abs(step[0]), std::abs(step[1]), std::abs(step[2])}));
}

/// The middle of what is sharp within two pixels; none where hardly anything is.
std::optional<double> sharpestNear(const Change& change, const ToolInPicture& tool, double s,
                                   double x) {
  double weight = 0, moment = 0;
  for (double at = x - 2; at <= x + 2; at += 0.25) {
    const double w = std::pow(edgeAt(change, tool, s, at), 2);
    weight += w;
    moment += w * at;
  }
  return weight > 17 * 3 ? std::optional(moment / weight) : std::nullopt;
}

/// The barrel's two edges: straight, as far from the line on both sides, the outermost of such
/// pairs that are nearly as sharp as the sharpest.
void findBarrel(const Change& change, double back, ToolInPicture* tool) {
  // Half of a barrel's width to a syringe's length; looked at more from behind it is more.
  constexpr double kStep = 0.25, kSlimmest = 0.065;
  const double first = 0.3 * back, last = 0.75 * back;
  const int columns = int(0.5 * back / kStep);
  const int rows = int(last - first) + 1;
  cv::Mat1f both(rows, columns, 0.f);
  for (int row = 0; row < rows; ++row)
    for (int column = 0; column < columns; ++column)
      both(row, column) = std::sqrt(edgeAt(change, *tool, first + row, column * kStep) *
                                    edgeAt(change, *tool, first + row, -column * kStep));
  struct Pair {
    double front = 0, end = 0;  ///< columns
    float score = 0;
  };
  std::vector<Pair> pairs;
  float best = 0;
  for (int front = int(kSlimmest * back / kStep); front < columns; ++front)
    for (int end = int(0.75 * front); end < std::min(columns, int(1.35 * front)); ++end) {
      float sum = 0;
      for (int row = 0; row < rows; ++row)
        sum += both(row, int(std::lround(front + (end - front) * double(row) / (rows - 1))));
      pairs.push_back({double(front), double(end), sum / float(rows)});
      best = std::max(best, pairs.back().score);
    }
  std::erase_if(pairs, [&](const Pair& p) { return p.score < 0.5f * best; });
  if (pairs.empty()) return;
  double outermost = 0;
  for (const Pair& p : pairs) outermost = std::max(outermost, p.front + p.end);
  Pair chosen;
  for (const Pair& p : pairs)
    if (p.front + p.end > outermost - 2 * 3 / kStep && p.score > chosen.score) chosen = p;
  for (int row = 0; row < rows; ++row) {
    const double s = first + row,
                 half = kStep * (chosen.front + (chosen.end - chosen.front) * row / (rows - 1));
    const auto left = sharpestNear(change, *tool, s, -half),
               right = sharpestNear(change, *tool, s, half);
    if (left && right) tool->barrel.push_back({s, *right - *left});
  }
}

/// Of the needle's light core across the line at s; none where there is no such line.
std::optional<double> coreAt(const Change& change, const ToolInPicture& tool, double s,
                             double reach) {
  const Vector2d across = tool.across();
  double weight = 0, moment = 0;
  for (double x = -reach; x <= reach; x += 0.5) {
    const auto place = [&](double at) { return brightness(change.now(tool.at(s) + at * across)); };
    const double ridge = place(x) - 0.5 * (place(x - 2.5) + place(x + 2.5));
    if (ridge < 15 || change.size(tool.at(s) + x * across) < kChanged) continue;
    weight += ridge * ridge;
    moment += ridge * ridge * x;
  }
  return weight > 0 ? std::optional(moment / weight) : std::nullopt;
}

/// From there to here, the line through the middles of the needle's core.
void straighten(const Change& change, double from, double to, double reach, ToolInPicture* tool) {
  const Vector2d across = tool->across();
  std::vector<cv::Point2f> middles;
  for (double s = from; s < to; s += 0.5)
    if (const auto x = coreAt(change, *tool, s, reach)) {
      const Vector2d p = tool->at(s) + *x * across;
      middles.emplace_back(float(p.x()), float(p.y()));
    }
  if (middles.size() < 20) return;
  cv::Vec4f line;
  cv::fitLine(middles, line, cv::DIST_HUBER, 0, 0.01, 0.01);
  Vector2d way(line[0], line[1]);
  if (way.dot(tool->along) < 0) way = -way;
  const Vector2d point(line[2], line[3]);
  tool->hub_px = point + way * way.dot(tool->hub_px - point);
  tool->along = way;
}

/// A needle here: something that is lighter than what lies right beside it, as thin as a needle.
bool isNeedle(const Change& change, const ToolInPicture& tool, double s) {
  constexpr float kLighter = 18;  // levels
  const Vector2d across = tool.across();
  const auto place = [&](double x) { return Vector2d(tool.at(s) + x * across); };
  float core = 0, beside = 255, changed = 0;
  for (double x = -1; x <= 1; x += 0.5) {
    core = std::max(core, brightness(change.now(place(x))));
    changed = std::max(changed, change.size(place(x)));
  }
  for (double x = 1.5; x <= kNeedleHalf_px; x += 0.5)
    for (const double sign : {-1.0, 1.0})
      beside = std::min(beside, brightness(change.now(place(sign * x))));
  return core - beside > kLighter && changed > kChanged;
}

/// From the hub toward the tip, until there is no needle for longer than between two dashes.
double tipOf(const Change& change, const ToolInPicture& tool, double from) {
  constexpr double kStep = 0.25, kGap = 9;
  double last = from;
  for (double s = from; s > from - 400 && last - s < kGap; s -= kStep)
    if (change.inside(tool.at(s)) && isNeedle(change, tool, s)) last = s;
  return last;
}

/// Halfway from what is there to pink.
double needleEndOf(const Change& change, const ToolInPicture& tool, double hub_half) {
  double most = 0;
  for (double s = -hub_half; s <= hub_half; s += 0.5)
    most = std::max(most, double(change.pinker(tool.at(s))));
  double s = 0;
  while (s > -3 * hub_half && change.pinker(tool.at(s)) > 0.5 * most) s -= 0.1;
  return s;
}

/// Where the syringe ends, along the line.
double endOf(const Change& change, const ToolInPicture& tool) {
  constexpr double kGap = 28;
  const Vector2d across = tool.across();
  double last = 0;
  for (double s = 0; s - last < kGap && change.inside(tool.at(s)); s += 1)
    for (double x = -3; x <= 3; x += 1)
      if (change.size(tool.at(s) + x * across) > kChanged) last = s;
  return last;
}

/// Beside the needle, where nothing else is: the middle of what has become lighter.
std::optional<double> ringOf(const Change& change, const ToolInPicture& tool) {
  const Vector2d across = tool.across();
  std::vector<double> bright;
  for (double s = tool.tip + 2; s < tool.needle_end - 2; s += 0.25) {
    double sum = 0;
    for (const double sign : {-1.0, 1.0})
      for (double x = kRingNear_px; x <= kRing_px; x += 0.5)
        sum += std::max(0.f, change.lighter(tool.at(s) + sign * x * across) - 12);
    bright.push_back(sum);
  }
  constexpr std::size_t kWindow = 32;  // 8 px
  double best = 0, at = 0;
  for (std::size_t i = 0; i + kWindow < bright.size(); ++i) {
    double sum = 0, moment = 0;
    for (std::size_t k = i; k < i + kWindow; ++k) sum += bright[k], moment += double(k) * bright[k];
    if (sum > best) best = sum, at = moment / sum;
  }
  if (best < 60) return std::nullopt;
  return tool.tip + 2 + 0.25 * at;
}

/// Where the needle's line turns from the colour of what lies under the skin, red, to steel's.
std::optional<double> tintOf(const Change& change, const ToolInPicture& tool) {
  constexpr float kRed = 0.31f;  // of red, more than of blue; bone has less
  const Vector2d across = tool.across();
  double last = tool.tip;
  for (double s = tool.tip; s < tool.needle_end; s += 0.25)
    for (double x = -1; x <= 1; x += 0.5)
      if (const cv::Vec3f rgb = change.now(tool.at(s) + x * across);
          rgb[0] > 90 && rgb[0] - rgb[2] > kRed * rgb[0])
        last = s;
  return last > tool.tip + 2 ? std::optional(last) : std::nullopt;
}

/// The direction of these points' line, unit: from the hub to where the tool is broader, as a
/// syringe is.
Vector2d towardPlunger(const std::vector<cv::Point>& tool, const Vector2d& hub_px) {
  cv::Vec4f line;
  cv::fitLine(tool, line, cv::DIST_HUBER, 0, 0.01, 0.01);
  const Vector2d along(line[0], line[1]), across(-along.y(), along.x());
  double broad = 0;
  for (const cv::Point& p : tool) {
    const Vector2d off = Vector2d(p.x, p.y) - hub_px;
    broad += std::copysign(std::pow(off.dot(across), 2), off.dot(along));
  }
  return broad < 0 ? Vector2d(-along) : along;
}

}  // namespace

std::optional<ToolInPicture> toolIn(const Change& change) {
  const cv::Mat1b hub = hubOf(change.pink());
  const std::vector<cv::Point> hub_points = pointsOf(hub);
  if (hub_points.size() < 30) return std::nullopt;
  const std::vector<cv::Point> all = pointsOf(partAt(change.thing(), hub));
  if (all.size() < 200) return std::nullopt;
  ToolInPicture tool;
  tool.hub_px = meanOf(hub_points);
  tool.along = towardPlunger(all, tool.hub_px);
  std::vector<double> hub_places;
  for (const cv::Point& p : hub_points)
    hub_places.push_back(tool.along.dot(Vector2d(p.x, p.y) - tool.hub_px));
  const double hub_half = quantile(hub_places, 0.98);
  for (const double far : {3.0, 4.0, 5.0, 6.0})
    straighten(change, -far * hub_half, -hub_half, 18 / far, &tool);
  const double back = endOf(change, tool);
  tool.needle_end = needleEndOf(change, tool, hub_half);
  tool.tip = tipOf(change, tool, tool.needle_end - 2);
  findBarrel(change, back, &tool);
  tool.ring = ringOf(change, tool);
  tool.tint = tintOf(change, tool);
  if (tool.needle_end - tool.tip < 5 || tool.barrel.size() < 10) return std::nullopt;
  return tool;
}

}  // namespace palpa::bench
