#include "scene/actors/skin_light.h"

#include <gtest/gtest.h>
#include <vtkCamera.h>
#include <vtkNew.h>
#include <vtkRenderWindow.h>
#include <vtkRenderer.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "scene/actors/organ_actors.h"
#include "scene/renderer_setup.h"
#include "scene/view/ar_camera.h"
#include "scene/window/pixels.h"
#include "tests/scene/offscreen.h"

/// What a patch of skin shows, whichever way it faces, against the law that it is said to follow.
namespace palpa::scene {
namespace {

constexpr int kSize = 64;
const Pinhole kCamera{kSize, kSize, 640, 640, 31.5, 31.5};
const Rgb kColour{0.8, 0.5, 0.4};
const Vec3 kToLight = Vec3(-0.35, 0.45, 1).normalized();  // right, up, toward who looks

/// A patch half a metre away, square to the line of sight, that says of itself that it faces `n`
/// (right, up, toward who looks).
anatomy::OrganSurface patchFacing(const Vec3& n) {
  anatomy::OrganSurface skin;
  skin.organ = Organ::skin;
  skin.rgba = {0.8f, 0.5f, 0.4f, 1};
  for (const double x : {-0.1, 0.1})
    for (const double y : {-0.1, 0.1}) skin.mesh.points.push_back({x, y, 0.5});
  skin.mesh.triangles = {{0, 1, 2}, {2, 1, 3}};
  skin.mesh.normals.assign(4, Vec3(n.x(), -n.y(), -n.z()));
  return skin;
}

Pixel seen(const Vec3& n, bool parallel = false) {
  anatomy::Patient patient;
  patient.organs.push_back(patchFacing(n));
  vtkRenderWindow& window = *offscreen().window();
  window.SetSize(kSize, kSize);
  window.SetNumberOfLayers(1);
  vtkNew<vtkRenderer> renderer;
  setUpRenderer(*renderer, {0, 0, 0});
  window.AddRenderer(renderer);
  Image image;
  {
    OrganActors organs(*renderer, patient);
    organs.setStyle(SkinStyle::solid);
    aim(*renderer->GetActiveCamera(), kCamera, Pose::Identity(), {0.05, 2});
    renderer->GetActiveCamera()->SetParallelProjection(parallel);
    window.Render();
    image = pixelsOf(window);
  }
  window.RemoveRenderer(renderer);
  return at(image, kSize / 2, kSize / 2);
}

/// The law, by angles instead of products.
Pixel expected(const Vec3& n) {
  const Vec3 eye(0, 0, 1), half_way = (eye + kToLight).normalized();
  const double nl = n.dot(kToLight), nv = n.z(), a = 0.35, f = 0.028;
  const double tan_h = std::tan(std::acos(std::min(n.dot(half_way), 1.0)));
  const double cos_h = n.dot(half_way);
  // Walter et al. 2007, eq. 33
  const double d = a * a /
                   (std::numbers::pi * std::pow(cos_h, 4) * std::pow(a * a + tan_h * tan_h, 2)),
               back = f + (1 - f) * std::pow(1 - eye.dot(half_way), 5),
               hides = 0.5 / ((1 - a) * 2 * std::max(nl, 0.0) * nv + a * (std::max(nl, 0.0) + nv));
  const double thrown = nl > 0 ? std::numbers::pi * nl * d * back * hides : 0;
  const double under[] = {0.30, 0.12, 0.08};
  int level[3];
  for (int c = 0; c < 3; ++c) {
    const double matt = std::max(0.0, (nl + under[c]) / (1 + under[c]));
    level[c] = static_cast<int>(
        std::lround(255 * std::min(1.0, 0.28 * kColour[c] + 0.76 * kColour[c] * matt + thrown)));
  }
  return {level[0], level[1], level[2]};
}

TEST(SkinLight, FollowsItsLawWhicheverWayTheSkinFaces) {
  int lit = 0, beyond = 0;
  for (int i = 0; i < 60; ++i) {
    const double down = 0.1 + 1.4 * (i % 10) / 9, round = 2 * std::numbers::pi * i / 60;
    const Vec3 n(std::sin(down) * std::cos(round), std::sin(down) * std::sin(round),
                 std::cos(down));
    EXPECT_LE(difference(seen(n), expected(n)), 2) << "facing " << n.transpose();
    EXPECT_LE(difference(seen(n, true), expected(n)), 2) << "in parallel, " << n.transpose();
    lit += n.dot(kToLight) > 0;
    beyond += n.dot(kToLight) < 0;
  }
  EXPECT_GT(lit, 30);
  EXPECT_GT(beyond, 5);
}

TEST(SkinLight, ShadowsHaveARedEdge) {
  const Vec3 side = kToLight.cross(Vec3::UnitZ()).normalized();
  const Vec3 edge = side.cross(kToLight).z() > 0 ? side.cross(kToLight) : kToLight.cross(side);
  const Pixel at_edge = seen(edge), in_light = seen(kToLight);
  EXPECT_GT(static_cast<double>(at_edge.r) / at_edge.g,
            1.15 * in_light.r / static_cast<double>(in_light.g));
}

}  // namespace
}  // namespace palpa::scene
