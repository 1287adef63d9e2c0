#include "scene/actors/tool_shadow.h"

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
#include <numbers>

#include "scene/actors/instrument.h"
#include "scene/actors/organ_actors.h"
#include "scene/palette.h"
#include "scene/renderer_setup.h"

namespace palpa::scene {
namespace {

constexpr double kFarthest = 0.3;               // m: of light that a tool stops
constexpr double kLamp = 0.05;                  // half-width of the penumbra to the distance
constexpr double kThinnest = 0.0009;            // m, half-width: a needle's shadow is to be seen
constexpr double kDark = 0.62, kPales = 0.045;  // at the skin; m, where half of it is left
constexpr double kOverSkin = 0.0004;            // m, above what lies on the skin
constexpr int kMostCrossings = 16;

/// The first way in; none where the ray begins inside.
std::optional<EntryPlace> firstEntry(const anatomy::TriangleTree& skin, const Vec3& from,
                                     const Vec3& way, double length) {
  std::array<anatomy::TriangleTree::Crossing, kMostCrossings> crossings;
  bool lost = false;
  const int count = skin.cast(from, way, length, crossings.data(), kMostCrossings, &lost);
  const auto end = crossings.begin() + count;
  const auto first = std::min_element(crossings.begin(), end,
                                      [](const auto& a, const auto& b) { return a.s < b.s; });
  if (first == end || !first->entering) return std::nullopt;
  return EntryPlace{from + first->s * way, first->normal.normalized()};
}

void addEvenly(double from, double to, double radius, double step,
               std::vector<ToolSection>* sections) {
  const int pieces = std::max(1, static_cast<int>(std::ceil((to - from) / step)));
  for (int i = 0; i <= pieces; ++i) sections->push_back({from + (to - from) * i / pieces, radius});
}

}  // namespace

std::vector<ToolSection> sectionsOf(Tool tool) {
  std::vector<ToolSection> sections;
  if (tool == Tool::needle) {
    const InstrumentSize size;
    addEvenly(0, size.needle_length, size.needle_radius, 0.004, &sections);
    addEvenly(size.needle_length + 0.006, -size.barrel_front - 0.002, 0.0034, 0.006, &sections);
    addEvenly(-size.barrel_front, size.barrel_length - size.barrel_front, size.barrel_radius, 0.012,
              &sections);
    return sections;
  }
  const ProbeSize size;
  for (const double share : {0.0, 0.05, 0.15, 0.3, 0.5, 0.75, 1.0})
    sections.push_back(
        {share * size.tip_radius, size.tip_radius * std::sqrt(1 - (1 - share) * (1 - share))});
  addEvenly(1.6 * size.tip_radius, -size.shaft_end, size.shaft_radius, 0.008, &sections);
  addEvenly(-size.shaft_end + 0.006, -size.handle_end, size.handle_radius, 0.012, &sections);
  return sections;
}

std::vector<std::optional<ShadowPlace>> shadowOf(Tool tool, const Pose& X_AT,
                                                 const anatomy::TriangleTree& skin) {
  std::vector<std::optional<ShadowPlace>> places;
  for (const ToolSection& section : sectionsOf(tool)) {
    const Vec3 p_A = X_AT * Vec3(0, 0, -section.behind);
    const std::optional<EntryPlace> hit = firstEntry(skin, p_A, -kTowardLight_A, kFarthest);
    if (!hit) {
      places.emplace_back();
      continue;
    }
    const double off = (hit->p_A - p_A).norm();
    places.push_back(ShadowPlace{hit->p_A, hit->n_A,
                                 std::max(section.radius, kThinnest) + kLamp * off,
                                 kDark / (1 + off / kPales)});
  }
  return places;
}

std::optional<EntryPlace> entryOf(const Pose& X_AT, const anatomy::TriangleTree& skin) {
  const double length = InstrumentSize().needle_length;
  return firstEntry(skin, X_AT * Vec3(0, 0, -length), X_AT.linear().col(2), length);
}

/// A strip along the places, four points across: clear at its edges, dark between.
class ToolShadows::Ribbon {
 public:
  explicit Ribbon(vtkRenderer& renderer) {
    colours_->SetNumberOfComponents(4);
    shape_->SetPoints(points_);
    shape_->SetPolys(cells_);
    shape_->GetPointData()->SetScalars(colours_);
    const vtkSmartPointer<vtkPolyDataMapper> mapper = makePassMapper();
    mapper->SetInputData(shape_);
    setWrites(*mapper, true, false);
    actor_->SetMapper(mapper);
    actor_->GetProperty()->LightingOff();
    actor_->ForceOpaqueOn();  // in the order of actors, and blended (see Glass)
    actor_->VisibilityOff();
    renderer.AddActor(actor_);
  }

  void show(const std::vector<std::optional<ShadowPlace>>& places, const Seen& seen) {
    points_->Reset();
    colours_->Reset();
    cells_->Reset();
    for (std::size_t i = 0; i < places.size(); ++i) {
      if (!places[i]) continue;
      const bool runs_out = i + 1 < places.size() && !places[i + 1];  // over the skin's edge
      add(*places[i], halfAcross(*places[i], along(places, i), seen),
          runs_out ? 0 : places[i]->dark);
      if (i > 0 && places[i - 1]) join();
    }
    for (vtkObject* changed : {static_cast<vtkObject*>(points_), static_cast<vtkObject*>(colours_),
                               static_cast<vtkObject*>(cells_), static_cast<vtkObject*>(shape_)})
      changed->Modified();
    actor_->SetVisibility(cells_->GetNumberOfCells() > 0);
  }
  void hide() { actor_->VisibilityOff(); }
  bool visible() const { return actor_->GetVisibility() != 0; }

 private:
  static constexpr int kAcross = 4;
  static constexpr std::array<double, kAcross> kPlaces{-1, -0.45, 0.45, 1}, kInk{0, 1, 1, 0};

  static Vec3 along(const std::vector<std::optional<ShadowPlace>>& places, std::size_t i) {
    const std::size_t before = i > 0 && places[i - 1] ? i - 1 : i,
                      after = i + 1 < places.size() && places[i + 1] ? i + 1 : i;
    const Vec3 way = places[after]->p_A - places[before]->p_A;
    return way.norm() > 1e-9 ? Vec3(way.normalized()) : Vec3(Vec3::UnitZ());
  }

  /// On the skin; across the line of sight where it would be too narrow.
  static Vec3 halfAcross(const ShadowPlace& place, const Vec3& way, const Seen& seen) {
    Vec3 on_skin = place.half_width * place.n_A.cross(way).normalized();
    const Vec3 sight = place.p_A - seen.eye_A, facing = sight.cross(way);
    const double least = seen.least * sight.norm(),
                 seen_width = on_skin.dot(facing) / facing.norm();
    if (!(std::abs(seen_width) < least)) return on_skin;
    return std::copysign(least, seen_width) * facing.normalized();
  }

  void add(const ShadowPlace& place, const Vec3& half_across, double dark) {
    for (std::size_t k = 0; k < kAcross; ++k) {
      const Vec3 p = place.p_A + kPlaces[k] * half_across + kOverSkin * place.n_A;
      points_->InsertNextPoint(p.data());
      const Rgb& ink = colour::kShadow;
      colours_->InsertNextTuple4(255 * ink[0], 255 * ink[1], 255 * ink[2], 255 * kInk[k] * dark);
    }
  }

  /// The last two rows of points.
  void join() {
    const vtkIdType last = points_->GetNumberOfPoints() - kAcross, before = last - kAcross;
    for (vtkIdType k = 0; k + 1 < kAcross; ++k)
      for (const auto& triangle :
           {std::array<vtkIdType, 3>{before + k, before + k + 1, last + k + 1},
            std::array<vtkIdType, 3>{before + k, last + k + 1, last + k}})
        cells_->InsertNextCell(3, triangle.data());
  }

  vtkNew<vtkPoints> points_;
  vtkNew<vtkUnsignedCharArray> colours_;
  vtkNew<vtkCellArray> cells_;
  vtkNew<vtkPolyData> shape_;
  vtkNew<vtkActor> actor_;
};

namespace {

std::vector<Vec3> ringAbout(const EntryPlace& entry) {
  constexpr int kCorners = 40;
  constexpr double kRadius = 0.0024;  // m
  const Mat3 R = rotationWithZ(entry.n_A);
  std::vector<Vec3> ring;
  for (int i = 0; i <= kCorners; ++i) {
    const double round = 2 * std::numbers::pi * i / kCorners;
    ring.push_back(entry.p_A +
                   R * Vec3(kRadius * std::cos(round), kRadius * std::sin(round), kOverSkin));
  }
  return ring;
}

}  // namespace

ToolShadows::ToolShadows(vtkRenderer& on_skin, const anatomy::Patient& patient)
    : ring_(on_skin, colour::kRing, 1.6) {
  if (const anatomy::OrganSurface* skin = seenSkin(patient))
    skin_ = std::make_unique<anatomy::TriangleTree>(skin->mesh);
  for (int i = 0; i < 2; ++i) ribbons_.push_back(std::make_unique<Ribbon>(on_skin));
}

ToolShadows::~ToolShadows() = default;

void ToolShadows::update(const SceneState& state, bool visible, const Seen& seen) {
  visible = visible && skin_ && state.show_tool && state.X_AB.matrix().isIdentity(0) &&
            state.skin != SkinStyle::hidden;
  ring_.hide();
  entry_A_.reset();
  for (const auto& ribbon : ribbons_) ribbon->hide();
  if (!visible) return;
  const auto entry =
      state.tool == Tool::needle ? entryOf(state.X_AT, *skin_) : std::optional<EntryPlace>();
  if (entry) entry_A_ = entry->p_A;
  if (!state.shadows) return;
  if (entry) ring_.show({ringAbout(*entry)});
  ribbons_[0]->show(shadowOf(state.tool, state.X_AT, *skin_), seen);
  if (state.second_X_AT) ribbons_[1]->show(shadowOf(Tool::probe, *state.second_X_AT, *skin_), seen);
}

bool ToolShadows::any() const {
  return ring_.visible() || std::any_of(ribbons_.begin(), ribbons_.end(),
                                        [](const auto& ribbon) { return ribbon->visible(); });
}

}  // namespace palpa::scene
