#include "apps/bench/scene_load.h"

#include <cmath>

#include "apps/bench/onlookers.h"
#include "apps/bench/reference_bust.h"
#include "scene/scene_view.h"

namespace palpa::bench {
namespace {

constexpr std::int64_t kFrame = 33'333'333;

void paint(scene::Image& image, int frame) {
  for (std::size_t i = 0; i < image.pixels.size(); ++i)
    image.pixels[i] = static_cast<std::uint8_t>(i / 96 + static_cast<std::size_t>(frame));
}

}  // namespace

struct SceneLoad::Impl {
  anatomy::Patient patient = referenceBust();
  scene::ViewLayout layout;
  std::unique_ptr<scene::GlContextProvider> context =
      scene::makeGlContext(scene::Display::offscreen, layout.width, layout.height, "Palpa");
  scene::SceneView view{*context, patient, layout};
  scene::Image picture{640, 480, 3, std::vector<std::uint8_t>(640 * 480 * 3)};
  scene::SceneState state;
  int frames = 0;
};

SceneLoad::SceneLoad() : impl_(std::make_unique<Impl>()) {}
SceneLoad::~SceneLoad() = default;
int SceneLoad::frames() const { return impl_->frames; }
std::string SceneLoad::drawnOn() const { return impl_->context->describe(); }

std::int64_t SceneLoad::step(std::int64_t now_ns) {
  Impl& own = *impl_;
  const Vec3 entry_A = own.patient.landmark(anatomy::landmark::kEntry);
  const double sway = std::sin(1e-9 * static_cast<double>(now_ns));
  paint(own.picture, own.frames);
  own.state.picture = &own.picture;
  own.state.registered = true;
  own.state.X_CA = lookAt(entry_A + Vec3(0.02 * sway, -0.45, 0.10), entry_A);
  own.state.X_AT = makePose(Quat(Eigen::AngleAxisd(-1.2, Vec3::UnitX())).toRotationMatrix(),
                            entry_A + Vec3(0, 0.01 * sway, 0));
  own.state.forces = {
      {scene::ForceKind::reaction, own.state.X_AT.translation(), Vec3(0, -1 - sway, 0)}};
  own.state.hud.force = std::to_string(1 + sway) + " N";
  own.view.show(own.state);
  if (onlookers_ && onlookers_->wantPicture()) onlookers_->show(own.view.capture());
  ++own.frames;
  return now_ns + kFrame;
}

}  // namespace palpa::bench
