#include "scene/actors/glass.h"

#include <vtkActor.h>
#include <vtkCellArray.h>
#include <vtkMapper.h>
#include <vtkPolyData.h>
#include <vtkProperty.h>
#include <vtkRenderWindow.h>
#include <vtkRenderer.h>
#include <vtkTypeInt64Array.h>

#include <algorithm>
#include <numeric>

#include "scene/palette.h"
#include "scene/renderer_setup.h"

namespace palpa::scene {
namespace {

constexpr double kEyeMoved = 0.005;  // of its distance

std::vector<std::array<long long, 3>> trianglesOf(vtkPolyData& surface) {
  std::vector<std::array<long long, 3>> triangles;
  vtkCellArray* cells = surface.GetPolys();
  triangles.reserve(static_cast<std::size_t>(cells->GetNumberOfCells()));
  vtkIdType count = 0;
  const vtkIdType* corners = nullptr;
  for (cells->InitTraversal(); cells->GetNextCell(count, corners);)
    if (count == 3) triangles.push_back({corners[0], corners[1], corners[2]});
  return triangles;
}

std::vector<Eigen::Vector3f> middlesOf(vtkPolyData& surface,
                                       const std::vector<std::array<long long, 3>>& triangles) {
  std::vector<Eigen::Vector3f> middles;
  middles.reserve(triangles.size());
  for (const auto& triangle : triangles) {
    Vec3 sum = Vec3::Zero(), p;
    for (const long long corner : triangle) {
      surface.GetPoint(corner, p.data());
      sum += p;
    }
    middles.push_back((sum / 3).cast<float>());
  }
  return middles;
}

/// Room for so many triangles; their corners are to be filled in.
vtkSmartPointer<vtkCellArray> listOf(std::size_t triangles) {
  const auto count = static_cast<vtkIdType>(triangles);
  vtkNew<vtkTypeInt64Array> offsets, corners;
  offsets->SetNumberOfValues(count + 1);
  for (vtkIdType i = 0; i <= count; ++i) offsets->SetValue(i, 3 * i);
  corners->SetNumberOfValues(3 * count);
  corners->FillValue(0);
  vtkNew<vtkCellArray> cells;
  cells->SetData(offsets, corners);
  return cells;
}

/// VTK's own translucent pass knows no order; its opaque pass draws one actor after the other, and
/// blends. What is nearer by a hair must not wipe out what comes next: no depths.
void drawInOrder(vtkActor& actor) {
  actor.ForceOpaqueOn();
  setWrites(*actor.GetMapper(), true, false);
  actor.GetProperty()->BackfaceCullingOn();
}

/// Of the box's nearest point.
double nearest(const Vec3& low, const Vec3& high, const Vec3& eye) {
  return (eye.cwiseMax(low).cwiseMin(high) - eye).norm();
}

}  // namespace

const std::vector<std::uint32_t>& FarFirst::order(const std::vector<float>& distances) {
  constexpr int kBits = 8, kDigits = 1 << kBits;
  constexpr float kAlike = 1e-9f;  // m
  const auto [near, far] = std::minmax_element(distances.begin(), distances.end());
  order_.resize(distances.size());
  std::iota(order_.begin(), order_.end(), 0u);
  if (near == far || !(*far - *near > kAlike)) return order_;
  const float farthest = *far, scale = 65535 / (*far - *near);
  keys_.resize(distances.size());
  for (std::size_t i = 0; i < keys_.size(); ++i)
    keys_[i] = static_cast<std::uint16_t>(scale * (farthest - distances[i]));
  next_.resize(distances.size());
  for (const int shift : {0, kBits}) {
    std::array<std::uint32_t, kDigits + 1> begin{};
    const auto digit = [&](std::uint32_t i) { return keys_[i] >> shift & (kDigits - 1); };
    for (const std::uint32_t i : order_) ++begin[static_cast<std::size_t>(digit(i) + 1)];
    std::partial_sum(begin.begin(), begin.end(), begin.begin());
    for (const std::uint32_t i : order_) next_[begin[static_cast<std::size_t>(digit(i))]++] = i;
    order_.swap(next_);
  }
  return order_;
}

Glass::Glass(vtkRenderWindow& window, vtkRenderer& behind)
    : window_(window), sorted_for_(Vec3::Zero()) {
  setUpRenderer(*renderer_, colour::kBehindBottom);
  renderer_->SetActiveCamera(behind.GetActiveCamera());
  renderer_->EraseOff();  // over the colours and depths of `behind`
  window_.AddRenderer(renderer_);
}

Glass::~Glass() { window_.RemoveRenderer(renderer_); }

void Glass::add(vtkActor* actor, vtkPolyData* surface) {
  Surface added;
  added.actor = actor;
  added.triangles = trianglesOf(*surface);
  added.middles = middlesOf(*surface, added.triangles);
  const double* b = surface->GetBounds();
  added.sorted = listOf(added.triangles.size());
  surface->SetPolys(added.sorted);
  added.low = {b[0], b[2], b[4]};
  added.high = {b[1], b[3], b[5]};
  drawInOrder(*actor);
  surfaces_.push_back(std::move(added));
  sorted_ = false;
}

void Glass::remove(vtkActor* actor) {
  std::erase_if(surfaces_, [&](const Surface& s) { return s.actor == actor; });
  actor->ForceOpaqueOff();
  setWrites(*actor->GetMapper(), true, true);
  renderer_->RemoveActor(actor);
}

void Glass::addBefore(vtkActor* actor) {
  drawInOrder(*actor);
  before_.push_back(actor);
  sorted_ = false;
}

void Glass::sort(const Surface& surface, const Vec3& eye) {
  const Eigen::Vector3f from = eye.cast<float>();
  distances_.resize(surface.middles.size());
  for (std::size_t i = 0; i < distances_.size(); ++i)
    distances_[i] = (surface.middles[i] - from).norm();
  vtkIdType* corner = surface.sorted->GetConnectivityArray64()->GetPointer(0);
  for (const std::uint32_t i : far_first_.order(distances_))
    corner = std::copy_n(surface.triangles[i].data(), 3, corner);
  surface.sorted->Modified();
}

void Glass::order(const Vec3& eye) {
  std::stable_sort(surfaces_.begin(), surfaces_.end(), [&](const Surface& a, const Surface& b) {
    return nearest(a.low, a.high, eye) > nearest(b.low, b.high, eye);
  });
  renderer_->RemoveAllViewProps();
  for (const Surface& surface : surfaces_) renderer_->AddActor(surface.actor);
  for (vtkActor* actor : before_) renderer_->AddActor(actor);
}

void Glass::look(const Vec3& eye) {
  const double distance =
      surfaces_.empty() ? 0 : (0.5 * (surfaces_.front().low + surfaces_.front().high) - eye).norm();
  if (sorted_ && (eye - sorted_for_).norm() < kEyeMoved * distance) return;
  for (const Surface& surface : surfaces_) sort(surface, eye);
  order(eye);
  sorted_for_ = eye;
  sorted_ = true;
}

}  // namespace palpa::scene
