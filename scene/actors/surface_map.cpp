#include "scene/actors/surface_map.h"

#include <vtkActor.h>
#include <vtkCellArray.h>
#include <vtkFloatArray.h>
#include <vtkImageData.h>
#include <vtkPointData.h>
#include <vtkPoints.h>
#include <vtkPolyData.h>
#include <vtkPolyDataMapper.h>
#include <vtkProperty.h>
#include <vtkRenderer.h>
#include <vtkTexture.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <utility>

#include "scene/renderer_setup.h"

namespace palpa::scene {

PictureSheet::PictureSheet(vtkRenderer& renderer) {
  vtkNew<vtkTexture> texture;
  texture->SetInputData(picture_);
  texture->InterpolateOn();
  texture->MipmapOff();
  texture->RepeatOff();
  texture->EdgeClampOn();
  const vtkSmartPointer<vtkPolyDataMapper> mapper = makePassMapper();
  mapper->SetInputData(sheet_);
  setWrites(*mapper, true, false);  // what lies under it is drawn later, and over it
  actor_->SetMapper(mapper);
  actor_->SetTexture(texture);
  actor_->GetProperty()->LightingOff();
  actor_->ForceOpaqueOn();  // in the order of actors, and blended (see Glass)
  actor_->VisibilityOff();
  renderer.AddActor(actor_);
}

PictureSheet::~PictureSheet() = default;

void PictureSheet::lay(int across, int along, const std::function<Vec3(double, double)>& at) {
  vtkNew<vtkPoints> points;
  vtkNew<vtkFloatArray> places;
  places->SetNumberOfComponents(2);
  places->SetName("TextureCoordinates");
  vtkNew<vtkCellArray> cells;
  for (int j = 0; j <= along; ++j) {
    for (int i = 0; i <= across; ++i) {
      const double u = static_cast<double>(i) / across, v = static_cast<double>(j) / along;
      points->InsertNextPoint(at(u, v).data());
      places->InsertNextTuple2(u, v);
      if (i == 0 || j == 0) continue;
      const vtkIdType last = j * (across + 1) + i, below = last - across - 1;
      for (const auto& triangle : {std::array<vtkIdType, 3>{below - 1, below, last},
                                   std::array<vtkIdType, 3>{below - 1, last, last - 1}})
        cells->InsertNextCell(3, triangle.data());
    }
  }
  sheet_->SetPoints(points);
  sheet_->SetPolys(cells);
  sheet_->GetPointData()->SetTCoords(places);
}

void PictureSheet::dye(int width, int height, const std::vector<std::uint8_t>& rgba) {
  picture_->SetDimensions(width, height, 1);
  picture_->AllocateScalars(VTK_UNSIGNED_CHAR, 4);
  std::copy(rgba.begin(), rgba.end(), static_cast<std::uint8_t*>(picture_->GetScalarPointer()));
  picture_->Modified();
}

void PictureSheet::setVisible(bool visible) { actor_->SetVisibility(visible); }
bool PictureSheet::visible() const { return actor_->GetVisibility() != 0; }

namespace {

constexpr double kOverPlane = 0.0003;  // m, below what has been felt
constexpr int kStep_texels = 12, kMostNodes = 128;
constexpr int kStripe_texels = 9, kStripe_wide = 3;
constexpr double kSure = 0.72, kUnsure = 0.42, kStripe = 0.85;  // opacity
constexpr double kPale = 0.45;                                  // of white in it

bool isSoundMap(const SurfaceMap& map) {
  const auto nodes = static_cast<std::size_t>(std::max(map.columns, 0)) *
                     static_cast<std::size_t>(std::max(map.rows, 0));
  return map.columns > 1 && map.rows > 1 && std::max(map.columns, map.rows) <= kMostNodes &&
         map.step_x > 0 && map.step_y > 0 && map.values.size() == nodes &&
         map.unsure.size() == nodes;
}

/// A place on the grid, in steps from its first node.
struct OnGrid {
  int column = 0, row = 0;
  double u = 0, v = 0;
  OnGrid(const SurfaceMap& map, double x, double y)
      : column(std::clamp(static_cast<int>(x), 0, map.columns - 2)),
        row(std::clamp(static_cast<int>(y), 0, map.rows - 2)),
        u(x - column),
        v(y - row) {}
  std::size_t node(const SurfaceMap& map, int right, int up) const {
    return static_cast<std::size_t>((row + up) * map.columns + column + right);
  }
};

double valueAt(const SurfaceMap& map, const OnGrid& at) {
  const auto value = [&](int right, int up) {
    return static_cast<double>(map.values[at.node(map, right, up)]);
  };
  return (1 - at.v) * ((1 - at.u) * value(0, 0) + at.u * value(1, 0)) +
         at.v * ((1 - at.u) * value(0, 1) + at.u * value(1, 1));
}

bool isUnsure(const SurfaceMap& map, const OnGrid& at) {
  return map.unsure[at.node(map, at.u > 0.5, at.v > 0.5)] != 0;
}

std::uint8_t byteOf(double share) {
  return static_cast<std::uint8_t>(std::lround(255 * std::clamp(share, 0.0, 1.0)));
}

Rgba inkAt(const SurfaceMap& map, const std::array<double, 2>& range, int x, int y) {
  const OnGrid at(map, (x + 0.5) / kStep_texels, (y + 0.5) / kStep_texels);
  const double width = range[1] - range[0];
  Rgb ink = scaleColour(width > 0 ? (valueAt(map, at) - range[0]) / width : 0.5);
  if (!isUnsure(map, at)) return {ink[0], ink[1], ink[2], kSure};
  const bool stripe = (x + y) % kStripe_texels < kStripe_wide;
  for (double& part : ink) part = stripe ? 1.0 : (1 - kPale) * part + kPale;
  return {ink[0], ink[1], ink[2], stripe ? kStripe : kUnsure};
}

std::string figure(double value) {
  char text[32];
  std::snprintf(text, sizeof text, "%.2g", value);
  return text;
}

}  // namespace

// Cividis (Nunez, Anderton, Renslow, PLoS ONE 13, 2018): its brightness rises evenly, and
// colour-blind eyes see what others see.
Rgb scaleColour(double share) {
  static constexpr std::array<std::array<int, 3>, 10> kStops{{{0, 32, 77},
                                                              {0, 51, 111},
                                                              {57, 72, 107},
                                                              {87, 92, 109},
                                                              {112, 113, 115},
                                                              {138, 135, 121},
                                                              {166, 157, 117},
                                                              {196, 181, 108},
                                                              {228, 207, 91},
                                                              {255, 234, 70}}};
  const double at = std::clamp(share, 0.0, 1.0) * (kStops.size() - 1);
  const std::size_t i = std::min(static_cast<std::size_t>(at), kStops.size() - 2);
  const double beyond = at - static_cast<double>(i);
  Rgb mixed{};
  for (std::size_t k = 0; k < 3; ++k)
    mixed[k] = ((1 - beyond) * kStops[i][k] + beyond * kStops[i + 1][k]) / 255;
  return mixed;
}

std::array<double, 2> rangeOf(const SurfaceMap& map) {
  if (map.values.empty()) return {0, 0};
  const auto [least, most] = std::minmax_element(map.values.begin(), map.values.end());
  return {static_cast<double>(*least), static_cast<double>(*most)};
}

ColourScale scaleOf(const SurfaceMap& map) {
  const auto [least, most] = rangeOf(map);
  const bool any = std::any_of(map.unsure.begin(), map.unsure.end(), [](int one) { return one; });
  return {map.title, figure(least), figure(most) + ' ' + map.unit, any};
}

void MapCarpet::update(const SurfaceMap* map, bool visible) {
  const bool shown = visible && map && isSoundMap(*map);
  if (shown && drawn_ != map) {
    sheet_.lay(1, 1, [&](double u, double v) {
      return map->X_AG * Vec3(map->low_x + u * (map->columns - 1) * map->step_x,
                              map->low_y + v * (map->rows - 1) * map->step_y, kOverPlane);
    });
    const int width = (map->columns - 1) * kStep_texels, height = (map->rows - 1) * kStep_texels;
    const std::array<double, 2> range = rangeOf(*map);
    std::vector<std::uint8_t> rgba;
    rgba.reserve(4 * static_cast<std::size_t>(width) * static_cast<std::size_t>(height));
    for (int y = 0; y < height; ++y)
      for (int x = 0; x < width; ++x)
        for (const double part : inkAt(*map, range, x, y)) rgba.push_back(byteOf(part));
    sheet_.dye(width, height, rgba);
    drawn_ = map;
  }
  sheet_.setVisible(shown);
}

}  // namespace palpa::scene
