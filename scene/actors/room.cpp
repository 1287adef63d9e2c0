#include "scene/actors/room.h"

#include <vtkActor.h>
#include <vtkCellArray.h>
#include <vtkPointData.h>
#include <vtkPoints.h>
#include <vtkPolyData.h>
#include <vtkPolyDataMapper.h>
#include <vtkProperty.h>
#include <vtkRenderer.h>
#include <vtkUnsignedCharArray.h>

#include <algorithm>
#include <array>
#include <cmath>

#include <Eigen/Geometry>

#include "scene/actors/table.h"
#include "scene/palette.h"
#include "scene/renderer_setup.h"

namespace palpa::scene {
namespace {

constexpr double kTableHigh = 0.74, kTableThick = 0.03, kLegWide = 0.05;  // m
constexpr double kLeastTable = 0.4;                                       // m, half of a side
constexpr double kHalfRoom = 2.4;                                         // m
constexpr double kRoomHigh = 2.6;                                         // m
constexpr double kTile = 0.6;                                             // m, of the floor
constexpr double kUnder = 5e-4;            // m: the table is below the shadow that lies on it
constexpr double kUnderTable_dark = 0.45;  // of the floor's light
constexpr Rgb kFloorLight{0.30, 0.31, 0.33}, kFloorDark{0.27, 0.28, 0.30};
constexpr Rgb kWallLow{0.33, 0.35, 0.38}, kWallHigh{0.45, 0.47, 0.50};
constexpr Rgb kCeiling{0.52, 0.54, 0.56};

Rgb mixed(const Rgb& a, const Rgb& b, double share) {
  Rgb colour;
  for (std::size_t i = 0; i < 3; ++i) colour[i] = a[i] + share * (b[i] - a[i]);
  return colour;
}

Rgb times(Rgb colour, double light) {
  for (double& part : colour) part *= light;
  return colour;
}

/// Four-cornered faces, each corner of its own colour.
class Painted {
 public:
  Painted() { colours_->SetNumberOfComponents(3); }

  void face(const std::array<Vec3, 4>& corners, const std::array<Rgb, 4>& colours) {
    vtkIdType ids[4];
    for (std::size_t i = 0; i < 4; ++i) {
      ids[i] = points_->InsertNextPoint(corners[i].data());
      colours_->InsertNextTuple3(255 * colours[i][0], 255 * colours[i][1], 255 * colours[i][2]);
    }
    faces_->InsertNextCell(4, ids);
  }
  void face(const std::array<Vec3, 4>& corners, const Rgb& colour) {
    face(corners, {colour, colour, colour, colour});
  }

  /// Its top light, its sides in between, nothing below.
  void box(const Vec3& low, const Vec3& high, const Rgb& top, const Rgb& side) {
    const auto corner = [&](bool x, bool y, bool z) {
      return Vec3(x ? high.x() : low.x(), y ? high.y() : low.y(), z ? high.z() : low.z());
    };
    face({corner(0, 0, 0), corner(1, 0, 0), corner(1, 0, 1), corner(0, 0, 1)}, top);
    for (const bool at : {false, true}) {
      face({corner(at, 0, 0), corner(at, 0, 1), corner(at, 1, 1), corner(at, 1, 0)},
           times(side, 0.9));
      face({corner(0, 0, at), corner(1, 0, at), corner(1, 1, at), corner(0, 1, at)}, side);
    }
  }

  vtkSmartPointer<vtkPolyData> surface() const {
    auto made = vtkSmartPointer<vtkPolyData>::New();
    made->SetPoints(points_);
    made->SetPolys(faces_);
    made->GetPointData()->SetScalars(colours_);
    return made;
  }

 private:
  vtkNew<vtkPoints> points_;
  vtkNew<vtkCellArray> faces_;
  vtkNew<vtkUnsignedCharArray> colours_;
};

struct Ground {
  Eigen::AlignedBox2d table;  ///< x, z
  double table_y = 0;
  double floorY() const { return table_y + kTableHigh; }
};

Ground groundOf(const anatomy::Patient& patient) {
  const TableTop top = tableUnder(patient).value_or(TableTop());
  const double half = std::max(top.half, kLeastTable);
  return {
      {top.middle - Eigen::Vector2d::Constant(half), top.middle + Eigen::Vector2d::Constant(half)},
      top.y};
}

void paintFloor(const Ground& ground, Painted& room) {
  const Eigen::Vector2d middle = ground.table.center();
  const int tiles = static_cast<int>(std::lround(kHalfRoom / kTile));
  const auto lightAt = [&](double x, double z) {
    const double away = ground.table.exteriorDistance(Eigen::Vector2d(x, z));
    return 1 - kUnderTable_dark * std::exp(-away * away / 0.08);
  };
  for (int i = -tiles; i < tiles; ++i)
    for (int j = -tiles; j < tiles; ++j) {
      const Rgb& tile = (i + j) % 2 == 0 ? kFloorLight : kFloorDark;
      std::array<Vec3, 4> corners;
      std::array<Rgb, 4> colours;
      constexpr int kCorners[4][2] = {{0, 0}, {1, 0}, {1, 1}, {0, 1}};
      for (std::size_t k = 0; k < 4; ++k) {
        const double x = middle.x() + kTile * (i + kCorners[k][0]),
                     z = middle.y() + kTile * (j + kCorners[k][1]);
        corners[k] = {x, ground.floorY(), z};
        colours[k] = times(tile, lightAt(x, z));
      }
      room.face(corners, colours);
    }
}

void paintWalls(const Ground& ground, Painted& room) {
  const Eigen::Vector2d m = ground.table.center();
  const double low = ground.floorY(), high = low - kRoomHigh;
  const std::array<Eigen::Vector2d, 4> corners{
      m + kHalfRoom * Eigen::Vector2d(-1, -1), m + kHalfRoom * Eigen::Vector2d(1, -1),
      m + kHalfRoom * Eigen::Vector2d(1, 1), m + kHalfRoom * Eigen::Vector2d(-1, 1)};
  std::array<Vec3, 4> above;
  for (std::size_t i = 0; i < 4; ++i) {
    const Eigen::Vector2d &a = corners[i], &b = corners[(i + 1) % 4];
    const double light = i % 2 == 0 ? 1 : 0.93;  // so that the corners are seen
    const Rgb foot = times(kWallLow, light), top = times(kWallHigh, light);
    room.face({Vec3(a.x(), low, a.y()), Vec3(b.x(), low, b.y()), Vec3(b.x(), high, b.y()),
               Vec3(a.x(), high, a.y())},
              {foot, foot, top, top});
    above[i] = {a.x(), high, a.y()};
  }
  room.face(above, kCeiling);
}

void paintTable(const Ground& ground, Painted& room) {
  const Eigen::Vector2d &low = ground.table.min(), &high = ground.table.max();
  const double top = ground.table_y + kUnder, below = top + kTableThick;
  const Rgb side = mixed(colour::kTable, kFloorDark, 0.5);
  room.box({low.x(), top, low.y()}, {high.x(), below, high.y()}, colour::kTable, side);
  for (const double x : {low.x(), high.x() - kLegWide})
    for (const double z : {low.y(), high.y() - kLegWide})
      room.box({x, below, z}, {x + kLegWide, ground.floorY(), z + kLegWide}, side,
               times(side, 0.8));
}

}  // namespace

Room::Room(vtkRenderer& renderer, const anatomy::Patient& patient) {
  const Ground ground = groundOf(patient);
  Painted room;
  paintFloor(ground, room);
  paintWalls(ground, room);
  paintTable(ground, room);
  const vtkSmartPointer<vtkPolyDataMapper> mapper = makePassMapper();
  mapper->SetInputData(room.surface());
  mapper->SetColorModeToDirectScalars();
  actor_->SetMapper(mapper);
  actor_->GetProperty()->LightingOff();
  renderer.AddActor(actor_);
}

Room::~Room() = default;

void Room::setVisible(bool visible) { actor_->SetVisibility(visible); }

}  // namespace palpa::scene
