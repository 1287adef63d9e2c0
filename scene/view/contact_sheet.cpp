#include "scene/view/contact_sheet.h"

#include <vtkCamera.h>
#include <vtkNew.h>
#include <vtkRenderWindow.h>
#include <vtkRenderer.h>

#include <algorithm>
#include <array>

#include "anatomy/base/error.h"
#include "scene/actors/organ_actors.h"
#include "scene/overlay/hud.h"
#include "scene/overlay/label.h"
#include "scene/renderer_setup.h"
#include "scene/view/framing.h"
#include "scene/window/pixels.h"

namespace palpa::scene {
namespace {

constexpr int kLeast_px = 300, kMost_px = 8192, kLine_px = 2;
constexpr std::array<int, 4> kScaleBars_mm{
    100, 50, 20, 10};               // the longest that takes no more than kBarShare is drawn
constexpr double kBarShare = 0.35;  // of a tile
constexpr double kRoom = 1.25;      // of the longest side a tile shows

struct SheetRow {
  SkinStyle style;
  const char* caption;
};
constexpr std::array<SheetRow, 3> kRows{{{SkinStyle::solid, "SOLID"},
                                         {SkinStyle::translucent, "TRANSLUCENT"},
                                         {SkinStyle::hidden, "BONES AND VESSELS"}}};
constexpr std::array<Plane, 3> kColumns{Plane::frontal, Plane::sagittal, Plane::axial};

/// What a row is framed on: all that it shows.
struct Framing {
  Vec3 centre_A;
  double half;
};
Framing frameOf(const anatomy::Patient& patient, const Region& region, SkinStyle style) {
  Eigen::AlignedBox3d box;
  for (const anatomy::OrganSurface& organ : patient.organs)
    if (!coversOrgans(organ.organ))
      for (const Vec3& p : organ.mesh.points) box.extend(p);
  if (style != SkinStyle::hidden || box.isEmpty())
    return {region.whole_centre_A, region.whole_half};
  return {box.center(), 0.5 * box.sizes().maxCoeff()};
}

bool hasBones(const anatomy::Patient& patient) {
  return std::any_of(patient.organs.begin(), patient.organs.end(),
                     [](const auto& organ) { return isBone(organ.organ); });
}

/// One picture of the page.
class Tile {
 public:
  Tile(vtkRenderWindow& window, const anatomy::Patient& patient, const Region& region,
       const SheetRow& row, Plane plane, const Rect& where)
      : window_(window), organs_(*renderer_, patient), plates_(*renderer_) {
    setUpRenderer(*renderer_, colour::kPanel);
    organs_.setStyle(row.style);
    const Aspect aspect = aspectOf(plane, patient.side);
    const double radius = region.whole_radius;
    vtkCamera* camera = renderer_->GetActiveCamera();
    const Framing frame = frameOf(patient, region, row.style);
    const Vec3 eye = frame.centre_A - 2 * radius * aspect.ahead_A;
    camera->ParallelProjectionOn();
    camera->SetPosition(eye.data());
    camera->SetFocalPoint(frame.centre_A.data());
    camera->SetViewUp(aspect.up_A.data());
    camera->SetClippingRange(0.01 * radius, 4 * radius);
    // The smaller side of the tile shows all of it, with room for the words.
    const double half = kRoom * frame.half;
    camera->SetParallelScale(where.width < where.height ? half * where.height / where.width : half);
    setViewport(*renderer_, where, window.GetSize()[0], window.GetSize()[1]);
    window_.AddRenderer(renderer_);
    const bool inside = row.style == SkinStyle::hidden && !hasBones(patient);
    write(inside ? "INSIDE" : row.caption, aspect, where,
          2 * camera->GetParallelScale() / where.height);
  }
  ~Tile() { window_.RemoveRenderer(renderer_); }
  Tile(const Tile&) = delete;
  Tile& operator=(const Tile&) = delete;

 private:
  void write(const std::string& caption, const Aspect& aspect, const Rect& where,
             double metres_a_pixel) {
    const TextStyle style{std::max(10, where.height / 26), true, colour::kText};
    const int line = lineHeight(style), margin = style.size_px / 2;
    put(std::string(aspect.caption) + "  " + caption, style, margin,
        where.height - margin - line / 2, Align::left);
    put(aspect.left, style, margin, where.height / 2, Align::left);
    put(aspect.right, style, where.width - margin, where.height / 2, Align::right);
    const auto bar = scaleBar(kScaleBars_mm, metres_a_pixel, kBarShare * where.width);
    if (!bar) return;
    const Rgb& ink = colour::kText;
    plates_.add({where.width - margin - bar->px, margin, bar->px, 3}, {ink[0], ink[1], ink[2], 1},
                0);
    put(std::to_string(bar->mm) + " mm", style, where.width - margin, margin + 6 + line / 2,
        Align::right);
  }
  void put(const std::string& words, const TextStyle& style, int x, int y, Align align) {
    labels_.push_back(std::make_unique<Label>(*renderer_));
    labels_.back()->set(said(words), style, x, y, align);
  }

  vtkRenderWindow& window_;
  vtkNew<vtkRenderer> renderer_;
  OrganActors organs_;
  Plates plates_;
  std::vector<std::unique_ptr<Label>> labels_;
};

}  // namespace

Image contactSheet(GlContextProvider& context, const anatomy::Patient& patient, int width,
                   int height) {
  if (width < kLeast_px || height < kLeast_px || width > kMost_px || height > kMost_px)
    throw UsageError(
        "cannot be " + std::to_string(width) + " x " + std::to_string(height) + " pixels",
        "the contact sheet", "Choose 300 to 8192");
  vtkRenderWindow& window = *context.window();
  window.SetSize(width, height);
  const Region region = regionOf(patient);
  std::vector<std::unique_ptr<Tile>> tiles;
  for (int r = 0; r < 3; ++r)
    for (int c = 0; c < 3; ++c) {
      const Rect where{c * width / 3, (2 - r) * height / 3, width / 3 - kLine_px,
                       height / 3 - kLine_px};
      tiles.push_back(std::make_unique<Tile>(window, patient, region,
                                             kRows[static_cast<std::size_t>(r)],
                                             kColumns[static_cast<std::size_t>(c)], where));
    }
  window.Render();
  return pixelsOf(window);
}

}  // namespace palpa::scene
