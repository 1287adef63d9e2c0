#include "apps/task_palpation/palpation_place.h"

#include <algorithm>
#include <cmath>

#include "anatomy/base/pinned_math.h"
#include "anatomy/base/units.h"
#include "anatomy/parametric/phantoms.h"

namespace palpa::task_palpation {
namespace {

constexpr double kSteepest = 1;     // 45 degrees
constexpr double kNarrowest = 1.2;  // of the tip's radius, that of a hollow

/// `otherwise` where the file says nothing.
double given(const JsonFile& file, const std::string& field, double low, double high,
             double otherwise) {
  return file.has(field) ? file.number(field, low, high) : otherwise;
}

TopMound moundIn(const JsonFile& file) {
  TopMound mound;
  mound.x = kMm * file.number("across_mm", -250, 250);
  mound.y = kMm * file.number("away_mm", -250, 250);
  mound.high = kMm * file.number("high_mm", -50, 50);
  mound.wide_u = kMm * given(file, "wide_across_mm", 2, 500, 0);
  mound.wide_v = kMm * given(file, "wide_away_mm", 2, 500, 0);
  if (mound.wide_u == 0 && mound.wide_v == 0)
    file.refuse("wide_across_mm", "is missing, as is \"wide_away_mm\": one of them must be there");
  const double turned = kDegree * given(file, "turned_deg", -180, 180, 0);
  mound.along_x = pinned::cos(turned);
  mound.along_y = pinned::sin(turned);
  return mound;
}

Eigen::Vector2d cornerIn(const JsonFile& file, const nlohmann::json& corner) {
  if (!corner.is_array() || corner.size() != 2 || !corner[0].is_number() || !corner[1].is_number())
    file.refuse("area/outline_mm",
                "holds " + corner.dump() + " where a point [across, away] must be");
  return kMm * Eigen::Vector2d(corner[0].get<double>(), corner[1].get<double>());
}

/// Calls `look` with places of the area 2 mm apart.
template <class Look>
void overArea(const assess::SearchArea& area, Look look) {
  constexpr double kStep = 2e-3;
  for (double x = -area.half_x; x <= area.half_x; x += kStep)
    for (double y = -area.half_y; y <= area.half_y; y += kStep)
      if (assess::insideBy(area, Vec3(x, y, 0)) >= 0) look(x, y);
}

}  // namespace

Vec3 sizeOf(const JsonFile& task) {
  return kMm * Vec3(task.number("phantom/across_mm", 10, 500),
                    task.number("phantom/away_mm", 10, 500),
                    task.number("phantom/high_mm", 5, 300));
}

TopShape topOf(const JsonFile& task) {
  const std::string at = "phantom/shape/";
  if (!task.has("phantom/shape")) return {};
  TopShape top;
  top.arch_high = kMm * given(task, at + "arch_high_mm", 1, 150, 0);
  if (top.arch_high > 0) {
    top.arch_half_x = kMm * task.number(at + "arch_half_across_mm", 10, 500);
    top.arch_half_y = kMm * given(task, at + "arch_half_away_mm", 10, 500, 0);
    top.arch_foot = kMm * task.number(at + "arch_foot_mm", 0.5, 100);
    top.taper = given(task, at + "taper_per_m", -10, 10, 0);
    if (std::abs(top.taper) * sizeOf(task).y() / 2 > 0.8)
      task.refuse(at + "taper_per_m", "would take the arch to nothing within the phantom");
  }
  top.hollow = given(task, at + "hollow_per_m", -20, 20, 0);
  const std::vector<JsonFile> mounds = task.entries(at + "mounds");
  if (mounds.size() > top.mounds.size())
    task.refuse(at + "mounds", "holds more than " + std::to_string(top.mounds.size()));
  for (const JsonFile& mound : mounds) top.mounds[top.mound_count++] = moundIn(mound);
  return onOrigin(top);
}

assess::SearchArea areaOf(const JsonFile& task) {
  assess::SearchArea area;
  area.half_x = kMm * task.number("area/half_across_mm", 5, 200);
  area.half_y = kMm * task.number("area/half_away_mm", 5, 200);
  area.top = topOf(task);
  if (!task.has("area/outline_mm")) return area;
  const nlohmann::json& outline = task.json().at("area").at("outline_mm");
  if (!outline.is_array() || outline.size() < 3)
    task.refuse("area/outline_mm", "must be a list of three points or more");
  for (const nlohmann::json& corner : outline) {
    area.outline.push_back(cornerIn(task, corner));
    const Eigen::Vector2d& p = area.outline.back();
    if (std::abs(p.x()) > area.half_x + 1e-9 || std::abs(p.y()) > area.half_y + 1e-9)
      task.refuse("area/outline_mm", "holds " + corner.dump() +
                                         ", beyond the rectangle of half_across_mm and "
                                         "half_away_mm");
  }
  return area;
}

std::optional<anatomy::BodyPart> seenAs(const JsonFile& task) {
  if (!task.has("phantom/seen_as")) return std::nullopt;
  const std::string word = task.text("phantom/seen_as");
  const auto part = anatomy::bodyPartNamed(word);
  if (!part)
    task.refuse("phantom/seen_as",
                "is \"" + word + "\"; it may be breast, abdomen, prostate or neck");
  return part;
}

anatomy::Patient shownPhantom(const Vec3& size, const std::string& title,
                              const assess::SearchArea& area,
                              const std::optional<anatomy::BodyPart>& seen_as) {
  anatomy::Patient phantom = anatomy::phantomBlock(size, title, area.top);
  if (seen_as)
    phantom.seen_as = anatomy::bodyPart(*seen_as, area.top, {area.half_x, area.half_y}, size.z());
  return phantom;
}

void requireTouchable(const JsonFile& task, const assess::SearchArea& area, double tip_radius) {
  if (area.top.flat()) return;
  double steepest = 0, hollowest = 0;
  overArea(area, [&](double x, double y) {
    const TopHeight h = heightOf(area.top, x, y);
    steepest = std::max(steepest, std::sqrt(h.zx * h.zx + h.zy * h.zy));
    hollowest = std::max(hollowest, -curvaturesOf(area.top, x, y)[1]);
  });
  if (steepest > kSteepest)
    task.refuse("phantom/shape", "is steeper than 45 degrees where it is searched");
  if (hollowest * kNarrowest * tip_radius > 1)
    task.refuse("phantom/shape", "has a hollow narrower than the tip where it is searched");
}

double leastHeight(const Vec3& size, const assess::SearchArea& area) {
  double least = size.z();
  overArea(area, [&](double x, double y) {
    least = std::min(least, size.z() + heightOf(area.top, x, y).z);
  });
  return least;
}

}  // namespace palpa::task_palpation
