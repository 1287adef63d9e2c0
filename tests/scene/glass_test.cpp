#include "scene/actors/glass.h"

#include <gtest/gtest.h>
#include <vtkCamera.h>
#include <vtkRenderWindow.h>
#include <vtkRenderer.h>

#include <algorithm>

#include "anatomy/base/random.h"
#include "scene/actors/organ_actors.h"
#include "scene/renderer_setup.h"
#include "scene/view/ar_camera.h"
#include "scene/window/pixels.h"
#include "tests/scene/offscreen.h"

/// Translucent surfaces within each other, beside VTK's depth peeling, which is right whatever it
/// costs.
namespace palpa::scene {
namespace {

constexpr int kSize = 300;
const Pinhole kCamera{kSize, kSize, 320, 320, 149.5, 149.5};

/// A trunk of skin with an arm beside it, a layer of muscle within, and opaque things inside that.
anatomy::Patient nested() {
  anatomy::Patient patient;
  test::add(patient, "skin", Organ::skin, test::sphere({0, 0, 0}, {0.10, 0.07, 0.12}));
  test::add(patient, "arm", Organ::skin, test::sphere({0.12, -0.06, 0}, {0.03, 0.03, 0.10}));
  test::add(patient, "muscle", Organ::muscle, test::sphere({0, 0, 0.01}, {0.085, 0.058, 0.09}));
  test::add(patient, "artery", Organ::artery, test::sphere({0.02, 0, 0}, Vec3::Constant(0.025)));
  test::add(patient, "bone", Organ::clavicle,
            test::sphere({-0.04, -0.01, 0.03}, {0.02, 0.02, 0.05}));
  return patient;
}

class TwoWays : public testing::Test {
 protected:
  /// As the AR view does it, or by peeling.
  Image draw(const anatomy::Patient& patient, const Pose& X_CA, bool peeling) {
    vtkRenderWindow& window = *offscreen().window();
    window.SetSize(kSize, kSize);
    window.SetNumberOfLayers(1);
    vtkNew<vtkRenderer> behind;
    setUpRenderer(*behind, {0.3, 0.3, 0.3});
    window.AddRenderer(behind);
    Image image;
    {
      std::unique_ptr<Glass> glass = peeling ? nullptr : std::make_unique<Glass>(window, *behind);
      const OrganActors organs(*behind, patient, glass.get());
      if (peeling) {
        behind->UseDepthPeelingOn();
        behind->SetMaximumNumberOfPeels(32);
        behind->SetOcclusionRatio(0);
      }
      aim(*behind->GetActiveCamera(), kCamera, X_CA, {0.05, 2});
      if (glass) glass->look(X_CA.inverse().translation());
      window.Render();
      image = pixelsOf(window);
    }
    window.RemoveRenderer(behind);
    return image;
  }

  /// Root mean square difference over all pixels on which anything is drawn, as a share of white.
  double rms(const Image& a, const Image& b) {
    double squares = 0;
    int n = 0;
    for (int v = 0; v < kSize; ++v)
      for (int u = 0; u < kSize; ++u) {
        const Pixel p = at(a, u, v), q = at(b, u, v), ground = at(a, 0, 0);
        if (difference(p, ground) < 2 && difference(q, ground) < 2) continue;
        squares += std::pow(p.r - q.r, 2) + std::pow(p.g - q.g, 2) + std::pow(p.b - q.b, 2);
        ++n;
      }
    EXPECT_GT(n, kSize * kSize / 10);
    return std::sqrt(squares / (3.0 * n)) / 255;
  }
};

TEST_F(TwoWays, NestedSurfacesAgreeWithDepthPeelingFromEverySide) {
  for (int side = 0; side < 6; ++side) {
    const double round = side * 1.0472;
    const Pose X_CA = lookAt({0.5 * std::sin(round), -0.5 * std::cos(round), 0.1}, {0, 0, 0});
    EXPECT_LT(rms(draw(nested(), X_CA, false), draw(nested(), X_CA, true)), 0.03) << side;
  }
}

/// The same picture whatever the order in which the patient's file has its surfaces.
TEST_F(TwoWays, TheOrderInTheFileDoesNotMatter) {
  anatomy::Patient turned = nested();
  std::reverse(turned.organs.begin(), turned.organs.end());
  const Pose X_CA = lookAt({0.2, -0.45, 0.1}, {0, 0, 0});
  EXPECT_LT(rms(draw(nested(), X_CA, false), draw(turned, X_CA, false)),
            0.002);  // half a level of 255: where two surfaces' centres are equally far
}

TEST(FarFirst, IsAnOrderByDistanceToASmallStep) {
  RandomStream random(1, "far first");
  for (const int count : {0, 1, 2, 10'000}) {
    std::vector<float> distances;
    for (int i = 0; i < count; ++i)
      distances.push_back(i % 7 == 0 ? 0.4f : static_cast<float>(random.uniform(0.3, 0.9)));
    FarFirst by_distance;
    const std::vector<std::uint32_t> order = by_distance.order(distances);
    std::vector<std::uint32_t> sorted = order;
    std::sort(sorted.begin(), sorted.end());
    for (std::uint32_t i = 0; i < sorted.size(); ++i) ASSERT_EQ(sorted[i], i);
    ASSERT_EQ(order.size(), distances.size());
    for (std::size_t i = 1; i < order.size(); ++i) {
      const float before = distances[order[i - 1]], now = distances[order[i]];
      EXPECT_LT(now, before + 1e-5f);
      if (now == before) {
        EXPECT_GT(order[i], order[i - 1]);
      }
    }
  }
}

}  // namespace
}  // namespace palpa::scene
