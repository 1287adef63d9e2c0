#include "scene/view/ar_view.h"

#include <vtkActor.h>
#include <vtkCamera.h>
#include <vtkProp.h>
#include <vtkPropCollection.h>
#include <vtkRenderWindow.h>
#include <vtkRenderer.h>
#include <vtkTexture.h>

#include <algorithm>
#include <numbers>

#include "anatomy/base/units.h"
#include "scene/palette.h"
#include "scene/renderer_setup.h"
#include "scene/view/ar_camera.h"

namespace palpa::scene {
namespace {

constexpr double kDistance = 0.42;  // metres from the virtual camera to the entry region
constexpr double kElevation = 28 * kDegree;
constexpr double kOnTable = -38 * kDegree;  // somebody who sits before it
constexpr double kAzimuth = 18 * kDegree;   // toward the punctured side
constexpr double kToolReach = 0.30;         // metres from the tip: the syringe, an arrow at its end
constexpr double kEyesApart = 0.063;        // metres, the mean of adults (Dodgson 2004)
constexpr double kNearestFocus = 0.1;
constexpr double kNearestThing = 0.05;                      // m from the camera, of what is real
constexpr double kThumbRest = 0.012, kThumbRadius = 0.010;  // m, of a plunger
constexpr double kNearestToEyes = 0.02;                     // m, in a room
constexpr double kShadowHalf_px = 2;  // the least half-width of a shadow, likewise
constexpr double kShaft_px = 5;       // an arrow's shaft in a window 720 pixels high
constexpr double kPin_px = 11;        // a pin's head, likewise

OrbitCamera defaultView(const anatomy::Patient& patient, const Region& region) {
  const double azimuth = patient.side == anatomy::Side::right ? -kAzimuth : kAzimuth;
  if (region.on_table) return {region.focus_A, 0, kOnTable, kDistance};
  return {region.focus_A, azimuth, kElevation, kDistance};
}

/// Throws Error when size and pixels disagree.
Image partOf(const Image& image, const Rect& part) {
  checkPicture(image);
  const auto channels = static_cast<std::size_t>(image.channels);
  const std::size_t row = channels * static_cast<std::size_t>(image.width),
                    length = channels * static_cast<std::size_t>(part.width);
  Image result{part.width, part.height, image.channels, {}};
  result.pixels.reserve(length * static_cast<std::size_t>(part.height));
  for (int v = part.y; v < part.top(); ++v) {
    const auto from = image.pixels.begin() +
                      static_cast<std::ptrdiff_t>(row * static_cast<std::size_t>(v) +
                                                  channels * static_cast<std::size_t>(part.x));
    result.pixels.insert(result.pixels.end(), from, from + static_cast<std::ptrdiff_t>(length));
  }
  return result;
}

}  // namespace

ArView::ArView(vtkRenderWindow& window, const anatomy::Patient& patient, const Region& region,
               const ViewLayout& layout)
    : window_(window),
      region_(region),
      stereo_(layout.stereo),
      see_through_(layout.see_through),
      shows_inside_(layout.inside),
      framed_(layout.framed),
      orbit_(defaultView(patient, region)),
      table_(*renderer_, patient),
      glass_((window.AddRenderer(renderer_), window), *renderer_),
      organs_(*renderer_, patient, &glass_),
      instrument_(*renderer_, &glass_),
      other_probe_(*renderer_, &glass_),
      arrows_(*above_, layout.force_colours),
      guide_(*above_, colour::kAdvice, 2.5),
      ellipse_(*above_, colour::kAdvice, 1.8),
      shadows_(*on_skin_, patient),
      needle_line_(*on_skin_),
      search_(*on_skin_, *above_, 2.5),
      compositor_(*on_skin_),
      occluders_(*renderer_) {
  organs_.setInside(layout.inside);
  if (layout.skin_deflection && organs_.skin())
    skin_ = std::make_unique<DeflectedSkin>(seenSkin(patient)->mesh, *organs_.skin());
  setUpRenderers();
  if (layout.creases) compositor_.shadeCreases();
  if (stereo_ == Stereo::headset && !see_through_)
    room_ = std::make_unique<Room>(*renderer_, patient);
  if (stereo_ == Stereo::headset)
    second_ =
        std::make_unique<SecondEye>(window_, *renderer_, glass_.renderer(), *on_skin_, *above_);
}

void ArView::setUpRenderers() {
  setUpRenderer(*renderer_, colour::kClear);
  for (vtkRenderer* renderer : {on_skin_.Get(), above_.Get()}) {
    setUpRenderer(*renderer, colour::kBehindBottom);
    renderer->SetActiveCamera(renderer_->GetActiveCamera());
    window_.AddRenderer(renderer);
  }
  on_skin_->EraseOff();  // over the colours and depths so far
  above_->SetLayer(1);
  renderer_->SetBackground2(colour::kBehindTop[0], colour::kBehindTop[1], colour::kBehindTop[2]);
}

ArView::~ArView() {
  window_.RemoveRenderer(above_);
  window_.RemoveRenderer(on_skin_);
  window_.RemoveRenderer(renderer_);
}

void ArView::addTrail(Trail& trail) { trail_ = trail.addTo(*renderer_, 2.5); }

void ArView::place(const Rect& panel, int window_width, int window_height) {
  panel_ = panel;
  window_width_ = window_width;
  window_height_ = window_height;
}

void ArView::update(const SceneState& state) {
  chooseCamera(state);
  applyCameras(state);
  compositor_.show(virtual_ ? state.picture : shown_picture_, state.look, state.smooth_edges);
  // Over a picture, and before the world, what is not drawn is black of alpha 0.
  const bool clear = state.picture || see_through_;
  const Rgb& behind = clear ? colour::kClear : colour::kBehindBottom;
  renderer_->SetBackground(behind[0], behind[1], behind[2]);
  renderer_->SetGradientBackground(!clear);
  shows_patient_ = state.registered || state.picture == nullptr;
  showPatient(state, shows_patient_);
  if (second_) second_->mirror();
}

void ArView::chooseCamera(const SceneState& state) {
  in_room_ = room_ && !state.picture;
  virtual_ = !state.registered && state.picture == nullptr;
  if (virtual_) {
    picture_ = panel_;
    pinhole_ = orbit_.pinhole(panel_.width, panel_.height);
    X_CA_ = orbit_.X_CA();
    return;
  }
  if (state.registered) X_CA_ = state.X_CA;
  choosePart(state);
  picture_ = letterbox(panel_, camera_.width, camera_.height);
  pinhole_ = scaled(camera_, picture_.width, picture_.height);
}

/// Of the picture, and of its camera.
void ArView::choosePart(const SceneState& state) {
  shown_picture_ = state.picture;
  camera_ = state.camera;
  const bool of_camera = !state.picture || (state.picture->width == state.camera.width &&
                                            state.picture->height == state.camera.height);
  if (!framed_ || !state.registered || !of_camera) return;
  part_ = partWithWork(state.camera, X_CA_ * region_.work_centre_A, region_.work_radius,
                       double(panel_.width) / panel_.height, part_);
  camera_ = partOf(state.camera, part_);
  if (!state.picture) return;
  part_picture_ = partOf(*state.picture, part_);
  shown_picture_ = &part_picture_;
}

/// One camera, or two that belong to it.
void ArView::applyCameras(const SceneState& state) {
  tip_A_ = state.X_AT.translation();
  real_things_ = !state.occluders.empty();
  glass_.look(X_CA_.inverse().translation());
  if (stereo_ == Stereo::none) return lookThrough({pinhole_, X_CA_}, picture_, *renderer_);
  const Pinhole whole = virtual_ ? pinhole_ : camera_;
  eyes_ = state.eyes ? *state.eyes
                     : stereoPair(whole, X_CA_, kEyesApart,
                                  std::max((X_CA_ * region_.focus_A).z(), kNearestFocus));
  eye_panels_ = second_ ? halvesOf(panel_) : std::array{panel_, panel_};
  for (std::size_t i = 0; i < 2; ++i) {
    eye_panels_[i] = letterbox(eye_panels_[i], eyes_[i].camera.width, eyes_[i].camera.height);
    eyes_[i].camera = scaled(eyes_[i].camera, eye_panels_[i].width, eye_panels_[i].height);
  }
  lookThrough(eyes_[0], eye_panels_[0], *renderer_);
  if (!second_) return;
  second_->forAll([&](vtkRenderer& renderer) {
    setViewport(renderer, eye_panels_[1], window_width_, window_height_);
  });
  lookThrough(eyes_[1], eye_panels_[1], second_->behind());
}

void ArView::lookThrough(const EyeCamera& eye, const Rect& where, vtkRenderer& behind) {
  if (&behind == renderer_.Get())
    for (vtkRenderer* renderer :
         {renderer_.Get(), on_skin_.Get(), above_.Get(), &glass_.renderer()})
      setViewport(*renderer, where, window_width_, window_height_);
  DepthRange range = depthRangeOf(
      {{eye.X_CA * region_.whole_centre_A, region_.whole_radius}, {eye.X_CA * tip_A_, kToolReach}});
  if (in_room_) range = {kNearestToEyes, Room::kReach};
  if (real_things_)
    range.near = std::min(range.near, kNearestThing);  // they stand anywhere before the patient
  aim(*behind.GetActiveCamera(), eye.camera, eye.X_CA, range);
}

void ArView::showEye(std::size_t eye) { lookThrough(eyes_[eye], eye_panels_[eye], *renderer_); }

void ArView::showLines(const SceneState& state, bool visible) {
  if (visible && state.guide)
    guide_.show(dashes(state.guide->from_A, state.guide->to_A));
  else
    guide_.hide();
  std::vector<Vec3> ellipse;
  if (visible && state.tip_covariance_A && !virtual_)
    ellipse =
        uncertaintyEllipse(*state.tip_covariance_A, state.X_AT.translation(), X_CA_, pinhole_);
  if (ellipse.empty())
    ellipse_.hide();
  else
    ellipse_.show({ellipse});
}

Surroundings ArView::toolOnScreen(const SceneState& state, std::size_t of) const {
  Surroundings around;
  if (!shows_patient_ || !state.show_tool) return around;
  const EyeCamera eye = this->eye(of);
  const Rect& where = eyePanel(of);
  const auto depth = [&](const Vec3& p_A) { return std::max((eye.X_CA * p_A).z(), kNearestThing); };
  const auto on_screen = [&](const Vec3& p_A) {
    const Vec3 p = eye.X_CA * p_A / depth(p_A);
    return Eigen::Vector2d(where.x + eye.camera.fx * p.x() + eye.camera.cx + 0.5,
                           where.top() - eye.camera.fy * p.y() - eye.camera.cy - 0.5);
  };
  const auto add = [&](Tool tool, const Pose& X_AT) {
    Vec3 before_A = X_AT.translation();
    for (const ToolSection& section : sectionsOf(tool)) {
      const Vec3 here_A = X_AT * Vec3(0, 0, -section.behind);
      around.tool.push_back(
          {on_screen(before_A), on_screen(here_A), section.radius * eye.camera.fx / depth(here_A)});
      before_A = here_A;
    }
    if (tool == Tool::needle) {  // the plunger's rod and thumb rest, as far as it is drawn
      const InstrumentSize size;
      const double end = size.barrel_length - size.barrel_front + kThumbRest +
                         std::clamp(state.plunger, 0.0, 1.0) * size.stroke;
      const Vec3 end_A = X_AT * Vec3(0, 0, -end);
      around.tool.push_back(
          {on_screen(before_A), on_screen(end_A), kThumbRadius * eye.camera.fx / depth(end_A)});
    }
    around.points.push_back(on_screen(X_AT.translation()));
  };
  add(state.tool, state.X_AT);
  if (state.second_X_AT) add(Tool::probe, *state.second_X_AT);
  if (const auto entry_A = shadows_.entry_A()) around.points.push_back(on_screen(*entry_A));
  return around;
}

double ArView::lineUnit_px() const { return std::max(window_height_ / 720.0, 1.0); }

void ArView::showNeedleLine(const SceneState& state, bool visible) {
  if (!visible || !state.show_tool || state.tool != Tool::needle) return needle_line_.hide();
  const double unit_px = lineUnit_px();
  const double scale = state.picture ? double(picture_.width) / camera_.width : 0;
  needle_line_.update(state, shadows_.entry_A(), X_CA_, pinhole_.fx, unit_px,
                      scale * state.look.blur_px, shows_inside_ && state.skin != SkinStyle::solid);
}

void ArView::showPatient(const SceneState& state, bool visible) {
  if (skin_) skin_->update(state.skin_push);
  table_.setVisible(visible && (virtual_ || in_room_) && !see_through_);
  if (room_) room_->setVisible(in_room_);
  shadows_.update(state, visible,
                  {X_CA_.inverse().translation(), kShadowHalf_px * lineUnit_px() / pinhole_.fx});
  organs_.setStyle(state.skin);
  organs_.setWalls(state.picture == nullptr && !see_through_);  // else one sees the real thing
  organs_.setVisible(visible);
  organs_.setPose(state.X_AB);
  other_probe_.update(state.second_X_AT.value_or(state.X_AT), 0, 0, Tissue::air);
  if (visible && state.second_X_AT)
    other_probe_.show(Tool::probe);
  else
    other_probe_.hide();
  instrument_.update(state.X_AT, state.plunger, state.blood, state.blood_of);
  if (visible && state.show_tool)
    instrument_.show(state.tool);
  else
    instrument_.hide();
  const double unit_px = window_height_ / 720.0;
  showNeedleLine(state, visible);
  if (trail_) trail_->SetVisibility(visible);
  arrows_.update(visible ? state.forces : std::vector<ForceArrow>(), X_CA_, pinhole_.fx,
                 kShaft_px * unit_px);
  showLines(state, visible);
  occluders_.update(state.occluders, visible && state.picture != nullptr);
  search_.update(state, visible, {X_CA_, pinhole_.fx}, kPin_px * unit_px);
  compositor_.setOn(!see_through_ || state.picture);  // it leaves no alpha
  on_skin_->SetDraw(!see_through_ || state.picture || search_.anyOnSkin() || shadows_.any() ||
                    needle_line_.visible());
  above_->SetDraw(search_.anyAbove() || arrows_.any() || ellipse_.visible() || guide_.visible());
}

}  // namespace palpa::scene
