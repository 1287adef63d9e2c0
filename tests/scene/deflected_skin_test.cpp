#include "scene/actors/organ_actors.h"

#include <gtest/gtest.h>
#include <vtkFloatArray.h>
#include <vtkPointData.h>
#include <vtkPoints.h>
#include <vtkPolyData.h>

#include "tests/scene/offscreen.h"

namespace palpa::scene {
namespace {

anatomy::TriangleMesh bowl() {
  return test::sheet(
      0.1, [](double x, double z) { return 0.9 * x * x + 0.35 * z * z; }, 101);
}

anatomy::SkinPush pushAt(double x, double depth) {
  return {{x, 0.9 * x * x, 0}, Vec3(1.8 * x, -1, 0).normalized(), depth, Vec3::Zero()};
}

std::vector<float> floats(vtkDataArray* array) {
  auto* values = vtkFloatArray::SafeDownCast(array);
  return {values->GetPointer(0), values->GetPointer(0) + values->GetNumberOfValues()};
}

class DrawnSkin : public testing::Test {
 protected:
  std::vector<float> points() const { return floats(drawn_->GetPoints()->GetData()); }
  std::vector<float> normals() const { return floats(drawn_->GetPointData()->GetNormals()); }

  const anatomy::TriangleMesh mesh_ = bowl();
  const vtkSmartPointer<vtkPolyData> drawn_ = polyDataOf(mesh_);
  DeflectedSkin skin_{mesh_, *drawn_};
};

TEST_F(DrawnSkin, IsPutBackBitForBitAfterAPushThatMoved) {
  const std::vector<float> before = points(), before_n = normals();
  for (int i = 0; i < 20; ++i) skin_.update(pushAt(0.002 * i - 0.02, 0.0002 * i - 0.001));
  EXPECT_NE(points(), before);
  EXPECT_NE(normals(), before_n);
  skin_.update(std::nullopt);
  EXPECT_EQ(points(), before);
  EXPECT_EQ(normals(), before_n);
}

TEST_F(DrawnSkin, MovesOnlyWhatLiesInThePatch) {
  const std::vector<float> before = points();
  const anatomy::SkinPush push = pushAt(0.01, 0.003);
  skin_.update(push);
  const std::vector<float> now = points();
  double deepest = 0;
  for (std::size_t i = 0; i < mesh_.points.size(); ++i) {
    const Vec3 was(before[3 * i], before[3 * i + 1], before[3 * i + 2]),
        is(now[3 * i], now[3 * i + 1], now[3 * i + 2]);
    if ((mesh_.points[i] - push.p_A).norm() > 0.060) {
      EXPECT_EQ(was, is);
    }
    deepest = std::max(deepest, (was - is).dot(push.n_A));
  }
  EXPECT_NEAR(deepest, 0.003, 0.0005);
}

TEST_F(DrawnSkin, TellsVtkOnlyWhenSomethingChanged) {
  const vtkMTimeType at_first = drawn_->GetMTime();
  skin_.update(std::nullopt);
  EXPECT_EQ(drawn_->GetMTime(), at_first);
  skin_.update(pushAt(0, 0.002));
  EXPECT_GT(drawn_->GetMTime(), at_first);
}

class DeflectedFrame : public testing::Test {
 protected:
  Image frame(SceneView& view, const std::optional<anatomy::SkinPush>& push) {
    state_.skin_push = push;
    view.show(state_);
    return view.capture();
  }
  DeflectedFrame() {
    test::add(patient_, "skin", Organ::skin, bowl());
    state_.registered = true;
    state_.camera = {320, 240, 500, 500, 159.5, 119.5};
    state_.X_CA = lookAt({0.1, -0.25, 0.1}, {0, 0, 0});
    state_.skin = SkinStyle::solid;
    state_.show_tool = false;
    state_.picture = &picture_;
  }
  const Image picture_ = plain(320, 240, 20);
  anatomy::Patient patient_;
  SceneState state_;
};

TEST_F(DeflectedFrame, ShowsTheDimpleWhereItIsAndThenNoMore) {
  SceneView view(offscreen(), patient_, {320, 240, FixedViews::none, true, true});
  const Image before = frame(view, std::nullopt), pressed = frame(view, pushAt(0, 0.004));
  const Blob dimple = changed(before, pressed);
  EXPECT_GT(dimple.count, 200);
  const Eigen::Vector2d wanted = project(state_.camera, state_.X_CA * Vec3(0, 0, 0));
  EXPECT_NEAR(dimple.u, wanted.x(), 12);
  EXPECT_NEAR(dimple.v, wanted.y(), 12);
  EXPECT_EQ(frame(view, std::nullopt).pixels, before.pixels);
}

TEST_F(DeflectedFrame, ShowsNothingUnlessTheViewIsMadeForIt) {
  SceneView view(offscreen(), patient_, {320, 240, FixedViews::none, true});
  const Image before = frame(view, std::nullopt);
  EXPECT_EQ(frame(view, pushAt(0, 0.004)).pixels, before.pixels);
}

}  // namespace
}  // namespace palpa::scene
