#include "scene/overlay/leaders.h"

#include <vtkActor2D.h>
#include <vtkCellArray.h>
#include <vtkCoordinate.h>
#include <vtkPoints.h>
#include <vtkPolyData.h>
#include <vtkPolyDataMapper2D.h>
#include <vtkProperty2D.h>
#include <vtkRenderer.h>

#include <algorithm>
#include <cmath>
#include <utility>

namespace palpa::scene {
namespace {

using Eigen::Vector2d;

double turn(const Vector2d& a, const Vector2d& b, const Vector2d& c) {
  return (b.x() - a.x()) * (c.y() - a.y()) - (b.y() - a.y()) * (c.x() - a.x());
}

bool cross(const PlacedName& one, const PlacedName& other) {
  const Vector2d &a = one.from, &b = one.of.at, &c = other.from, &d = other.of.at;
  return turn(a, b, c) * turn(a, b, d) < 0 && turn(c, d, a) * turn(c, d, b) < 0;
}

/// Heights as near as may be to those wished for, `line` apart: from the bottom up, then pushed
/// down from the top.
void spread(std::vector<PlacedName>& column, const NameColumns& c) {
  const int half = c.line / 2;
  int lowest = c.bottom + half;
  for (PlacedName& one : column) {
    one.y = std::max(static_cast<int>(std::lround(one.of.at.y())), lowest);
    lowest = one.y + c.line;
  }
  int highest = c.top - half;
  for (auto one = column.rbegin(); one != column.rend(); ++one) {
    one->y = std::min(one->y, highest);
    highest = one->y - c.line;
  }
}

/// Two lines that cross do not when their names change places, and both get shorter: it ends.
void uncross(std::vector<PlacedName>& column) {
  for (bool changed = true; changed;) {
    changed = false;
    for (std::size_t i = 0; i < column.size(); ++i)
      for (std::size_t j = i + 1; j < column.size(); ++j) {
        if (!cross(column[i], column[j])) continue;
        std::swap(column[i].of, column[j].of);
        changed = true;
      }
  }
}

std::vector<PlacedName> columnOf(std::vector<NamedPlace> places, bool on_left,
                                 const NameColumns& c) {
  const auto room = static_cast<std::size_t>(std::max(0, (c.top - c.bottom) / c.line));
  if (places.size() > room) places.resize(room);
  std::sort(places.begin(), places.end(),
            [](const NamedPlace& a, const NamedPlace& b) { return a.at.y() < b.at.y(); });
  std::vector<PlacedName> column;
  for (NamedPlace& place : places) {
    PlacedName one;
    one.of = std::move(place);
    one.align = on_left ? Align::right : Align::left;
    one.x = on_left ? c.left : c.right;
    column.push_back(std::move(one));
  }
  spread(column, c);
  for (PlacedName& one : column) one.from = {one.x + (on_left ? c.gap : -c.gap), one.y};
  uncross(column);
  return column;
}

}  // namespace

std::vector<PlacedName> placeNames(std::vector<NamedPlace> places, const NameColumns& columns) {
  std::vector<double> across;
  for (const NamedPlace& place : places) across.push_back(place.at.x());
  std::sort(across.begin(), across.end());
  std::vector<NamedPlace> left, right;
  for (NamedPlace& place : places) {
    const bool on_left = place.at.x() < across[across.size() / 2];
    (on_left ? left : right).push_back(std::move(place));
  }
  std::vector<PlacedName> all = columnOf(std::move(left), true, columns);
  for (PlacedName& one : columnOf(std::move(right), false, columns)) all.push_back(std::move(one));
  return all;
}

LeaderLines::LeaderLines(vtkRenderer& renderer, const Rgb& ink, double width_px)
    : dots_(renderer),
      ink_{ink[0], ink[1], ink[2], 1},
      dot_px_(static_cast<int>(std::lround(4 * width_px))) {
  shape_->SetPoints(vtkNew<vtkPoints>());
  shape_->SetLines(vtkNew<vtkCellArray>());
  vtkNew<vtkCoordinate> pixels;
  pixels->SetCoordinateSystemToViewport();
  vtkNew<vtkPolyDataMapper2D> mapper;
  mapper->SetInputData(shape_);
  mapper->SetTransformCoordinate(pixels);
  actor_->SetMapper(mapper);
  actor_->GetProperty()->SetColor(ink[0], ink[1], ink[2]);
  actor_->GetProperty()->SetLineWidth(static_cast<float>(width_px));
  renderer.AddActor2D(actor_);
}

LeaderLines::~LeaderLines() = default;

void LeaderLines::add(const Vector2d& from, const Vector2d& to) {
  const vtkIdType ends[] = {shape_->GetPoints()->InsertNextPoint(from.x(), from.y(), 0),
                            shape_->GetPoints()->InsertNextPoint(to.x(), to.y(), 0)};
  shape_->GetLines()->InsertNextCell(2, ends);
  shape_->Modified();
  dots_.add({static_cast<int>(std::lround(to.x())) - dot_px_ / 2,
             static_cast<int>(std::lround(to.y())) - dot_px_ / 2, dot_px_, dot_px_},
            ink_, dot_px_ / 2);
}

}  // namespace palpa::scene
