#include "scene/view/anatomical_plate.h"

#include <vtkCamera.h>
#include <vtkNew.h>
#include <vtkRenderWindow.h>
#include <vtkRenderer.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <memory>
#include <string>
#include <vector>

#include <Eigen/Geometry>

#include "anatomy/base/error.h"
#include "scene/actors/cut_organs.h"
#include "scene/actors/organ_actors.h"
#include "scene/overlay/label.h"
#include "scene/overlay/leaders.h"
#include "scene/renderer_setup.h"
#include "scene/window/pixels.h"

namespace palpa::scene {
namespace {

constexpr Rgb kPaper{1, 1, 1};
constexpr int kFiner = 2;             // drawn so much larger, then averaged: smooth edges
constexpr double kColumn = 0.17;      // of the width, for the names on either side
constexpr double kHead = 0.09;        // of the height, for the title above and the bar below
constexpr int kLeastSeen_px = 3;      // deep, of what gets a name
constexpr double kBarLongest = 0.16;  // of the width
constexpr std::array kBars_mm{200, 100, 50, 20, 10, 5};

/// `cut`: what a skin holds is seen.
const char* printedName(Organ organ, bool cut) {
  switch (organ) {
    case Organ::skin:
      return cut ? "skin and fat" : "skin";
    case Organ::rib:
      return "ribs";
    case Organ::cartilage:
      return "rib cartilage";
    case Organ::airway:
      return "windpipe";
    case Organ::inclusion:
      return "lump";
    case Organ::scapula:
      return "shoulder blade";
    default:
      return name(organ);
  }
}

/// How the picture lies in space: across, up and into it, about its middle; all parallel.
struct PlateSight {
  Vec3 middle_A, right_A, up_A, ahead_A;
  double metres_a_pixel = 1e-3;
  int width = 0, height = 0;

  Eigen::Vector2d pixelOf(const Vec3& p_A) const {
    const Vec3 d = p_A - middle_A;
    return {0.5 * width + d.dot(right_A) / metres_a_pixel,
            0.5 * height + d.dot(up_A) / metres_a_pixel};
  }
};

/// All that is shown, seen that way.
PlateSight sightOf(const anatomy::Patient& patient, const Aspect& aspect, SkinStyle skin, int width,
                   int height) {
  PlateSight sight;
  sight.width = width;
  sight.height = height;
  sight.ahead_A = aspect.ahead_A;
  sight.up_A = aspect.up_A;
  sight.right_A = aspect.ahead_A.cross(aspect.up_A).normalized();
  Mat3 R;
  R << sight.right_A, sight.up_A, sight.ahead_A;
  Eigen::AlignedBox3d box;
  for (const anatomy::OrganSurface& organ : patient.organs)
    if (!coversOrgans(organ.organ) || skin != SkinStyle::hidden)
      for (const Vec3& p : organ.mesh.points) box.extend(Vec3(R.transpose() * p));
  if (box.isEmpty())
    throw UsageError("has nothing to show without its skin", "the picture",
                     "Add --skin solid or translucent");
  sight.middle_A = R * box.center();
  sight.metres_a_pixel = std::max(box.sizes().x() / ((1 - 2 * kColumn) * width),
                                  box.sizes().y() / ((1 - 2 * kHead) * height));
  return sight;
}

void aim(vtkCamera& camera, const PlateSight& sight) {
  constexpr double kAway = 2;  // m
  const Vec3 eye = sight.middle_A - kAway * sight.ahead_A;
  camera.ParallelProjectionOn();
  camera.SetPosition(eye.data());
  camera.SetFocalPoint(sight.middle_A.data());
  camera.SetViewUp(sight.up_A.data());
  camera.SetClippingRange(0.1, 2 * kAway);
  camera.SetParallelScale(0.5 * sight.height * sight.metres_a_pixel);
}

/// How deep each pixel lies inside what is of its own colour, in steps to a side.
std::vector<int> depthsInside(const std::vector<std::uint8_t>& kinds, int width, int height) {
  std::vector<int> depth(kinds.size());
  const auto at = [&](int x, int y) { return static_cast<std::size_t>(y) * width + x; };
  const auto grow = [&](int x, int y, int from_x, int from_y) {
    const bool beyond = from_x < 0 || from_y < 0 || from_x >= width || from_y >= height;
    const std::size_t here = at(x, y);
    const int there =
        beyond || kinds[at(from_x, from_y)] != kinds[here] ? 0 : depth[at(from_x, from_y)];
    depth[here] = std::min(depth[here], there + 1);
  };
  std::fill(depth.begin(), depth.end(), width + height);
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x) grow(x, y, x - 1, y), grow(x, y, x, y - 1);
  for (int y = height - 1; y >= 0; --y)
    for (int x = width - 1; x >= 0; --x) grow(x, y, x + 1, y), grow(x, y, x, y + 1);
  return depth;
}

/// Of each kind the place deepest inside what is seen of it.
std::vector<NamedPlace> seenKinds(const Image& painted, bool cut) {
  std::vector<std::uint8_t> kinds(painted.pixels.size() / 3);
  for (std::size_t i = 0; i < kinds.size(); ++i) kinds[i] = painted.pixels[3 * i];
  const std::vector<int> depth = depthsInside(kinds, painted.width, painted.height);
  std::array<std::size_t, kOrganCount> deepest{};
  std::array<int, kOrganCount> best{};
  for (std::size_t i = 0; i < kinds.size(); ++i) {
    const auto kind = static_cast<std::size_t>(CutOrgans::kindOf(kinds[i]));
    if (kind >= kOrganCount || depth[i] <= best[kind]) continue;
    best[kind] = depth[i];
    deepest[kind] = i;
  }
  std::vector<NamedPlace> places;
  for (std::size_t kind = 1; kind < kOrganCount; ++kind) {
    if (best[kind] < kFiner * kLeastSeen_px) continue;
    const auto x = static_cast<int>(deepest[kind]) % painted.width,
               y = static_cast<int>(deepest[kind]) / painted.width;
    places.push_back({printedName(static_cast<Organ>(kind), cut),
                      {x, painted.height - 1 - y}});  // its rows begin at the top
  }
  return places;
}

Image averaged(const Image& fine) {
  Image image;
  image.width = fine.width / kFiner;
  image.height = fine.height / kFiner;
  image.pixels.resize(std::size_t{3} * image.width * image.height);
  for (int y = 0; y < image.height; ++y)
    for (int x = 0; x < image.width; ++x)
      for (int c = 0; c < 3; ++c) {
        int sum = 0;
        for (int j = 0; j < kFiner; ++j)
          for (int i = 0; i < kFiner; ++i)
            sum += fine.pixels[3 * (std::size_t(kFiner * y + j) * fine.width + kFiner * x + i) + c];
        image.pixels[3 * (std::size_t(y) * image.width + x) + c] =
            static_cast<std::uint8_t>((sum + kFiner * kFiner / 2) / (kFiner * kFiner));
      }
  return image;
}

class PlatePage {
 public:
  PlatePage(vtkRenderer& renderer, const PlateSight& sight)
      : renderer_(renderer),
        sight_(sight),
        text_(std::max(kFiner * kSmallestText_px, sight.height / 42)),
        lines_(renderer, colour::kInk, kFiner),
        bar_(renderer) {}

  void names(const std::vector<NamedPlace>& places) {
    const TextStyle style{text_, false, colour::kInk};
    NameColumns columns;
    columns.left = static_cast<int>((kColumn - 0.02) * sight_.width);
    columns.right = sight_.width - columns.left;
    columns.bottom = static_cast<int>(kHead * sight_.height);
    columns.top = sight_.height - columns.bottom;
    columns.line = lineHeight(style) * 3 / 2;
    columns.gap = text_ / 3;
    for (const PlacedName& one : placeNames(places, columns)) {
      lines_.add(one.from, one.of.at);
      put(one.of.name, style, one.x, one.y, one.align);
    }
  }

  void title(const std::string& words, const std::string& whose) {
    const int margin = text_, line = lineHeight({text_});
    put(words, {text_ * 5 / 4, true, colour::kInk}, margin, sight_.height - margin - line / 2,
        Align::left);
    put(whose, {text_ * 4 / 5, false, colour::kInk}, margin, margin, Align::left);
  }

  void sides(const Aspect& aspect) {
    const TextStyle style{text_, true, colour::kInk};
    const int x = static_cast<int>(kColumn * sight_.width) / 4;
    put(said(aspect.left), style, x, sight_.height / 2, Align::centre);
    put(said(aspect.right), style, sight_.width - x, sight_.height / 2, Align::centre);
    const int beyond = static_cast<int>((0.5 - kHead) * sight_.height) + text_ * 2 / 3;
    put(said(aspect.top), style, sight_.width / 2, sight_.height / 2 + beyond, Align::centre);
    put(said(aspect.bottom), style, sight_.width / 2, sight_.height / 2 - beyond, Align::centre);
  }

  void bar() {
    const auto length = scaleBar(kBars_mm, sight_.metres_a_pixel, kBarLongest * sight_.width);
    if (!length) return;
    const Rgb& ink = colour::kInk;
    const int x = sight_.width - text_ - length->px;
    bar_.add({x, text_, length->px, text_ / 4}, {ink[0], ink[1], ink[2], 1}, 0);
    put(said(std::to_string(length->mm) + " mm"), {text_, false, ink}, x + length->px / 2,
        text_ * 3 / 2 + lineHeight({text_}) / 2, Align::centre);
  }

 private:
  void put(const std::string& words, const TextStyle& style, int x, int y, Align align) {
    if (words.empty()) return;
    labels_.push_back(std::make_unique<Label>(renderer_));
    labels_.back()->set(words, style, x, y, align);
  }

  vtkRenderer& renderer_;
  const PlateSight& sight_;
  const int text_;
  LeaderLines lines_;
  Plates bar_;
  std::vector<std::unique_ptr<Label>> labels_;
};

Vec3 referenceOf(const anatomy::Patient& patient, const Region& region) {
  const auto entry = patient.landmarks.find(anatomy::landmark::kEntry);
  return entry == patient.landmarks.end() ? region.whole_centre_A : entry->second;
}

std::string titleOf(const Aspect& aspect, const PlateWish& wish, bool by_entry) {
  std::string words = aspect.caption;
  if (!wish.section) return words;
  const long mm = std::lround(1e3 * *wish.section);
  const std::string of = by_entry ? "the entry point" : "the middle";
  if (mm == 0) return words + ", cut through " + of;
  const bool from_above = wish.plane == Plane::axial;
  const std::string farther = from_above ? "below " : "behind ",
                    nearer = from_above ? "above " : "before ";
  return words + ", cut " + std::to_string(std::abs(mm)) + " mm " + (mm > 0 ? farther : nearer) +
         of;
}

/// Only while it lives is the window as large, and what is drawn in it.
class FineRenderer {
 public:
  FineRenderer(vtkRenderWindow& window, int width, int height) : window_(window) {
    window_.SetSize(width, height);
    setUpRenderer(*renderer_, kPaper);
    setViewport(*renderer_, {0, 0, width, height}, width, height);
    window_.AddRenderer(renderer_);
  }
  ~FineRenderer() { window_.RemoveRenderer(renderer_); }
  FineRenderer(const FineRenderer&) = delete;
  FineRenderer& operator=(const FineRenderer&) = delete;

  vtkRenderer& operator*() { return *renderer_; }
  Image draw(const Rgb& background) {
    renderer_->SetBackground(background[0], background[1], background[2]);
    window_.Render();
    return pixelsOf(window_);
  }

 private:
  vtkRenderWindow& window_;
  vtkNew<vtkRenderer> renderer_;
};

}  // namespace

Image anatomicalPlate(GlContextProvider& context, const anatomy::Patient& patient,
                      const PlateWish& wish) {
  constexpr int kLeastWide = 400, kLeastHigh = 300, kMost = 4096;
  if (wish.width < kLeastWide || wish.height < kLeastHigh ||
      std::max(wish.width, wish.height) > kMost)
    throw UsageError(
        "cannot be " + std::to_string(wish.width) + " x " + std::to_string(wish.height) + " pixels",
        "the plate", "Choose 400 x 300 to 4096 x 4096");
  const Region region = regionOf(patient);
  const Aspect aspect =
      region.on_table ? aspectOnTable(wish.plane) : aspectOf(wish.plane, patient.side);
  const PlateSight sight =
      sightOf(patient, aspect, wish.skin, kFiner * wish.width, kFiner * wish.height);
  std::optional<Section> section;
  if (wish.section)
    section = {referenceOf(patient, region) + *wish.section * aspect.ahead_A, aspect.ahead_A};
  FineRenderer fine(*context.window(), sight.width, sight.height);
  aim(*(*fine).GetActiveCamera(), sight);
  CutOrgans organs(*fine, patient, section, wish.skin);
  organs.paintKinds(true);
  std::vector<NamedPlace> places = seenKinds(fine.draw({0, 0, 0}), section.has_value());
  organs.paintKinds(false);
  const auto entry = patient.landmarks.find(anatomy::landmark::kEntry);
  const bool by_entry = entry != patient.landmarks.end();
  if (by_entry && !section) places.push_back({"entry point", sight.pixelOf(entry->second)});
  PlatePage page(*fine, sight);
  for (NamedPlace& place : places) place.name = said(place.name);
  page.title(said(titleOf(aspect, wish, by_entry)), patient.name);
  page.sides(aspect);
  page.names(places);
  page.bar();
  return averaged(fine.draw(kPaper));
}

}  // namespace palpa::scene
