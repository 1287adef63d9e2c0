#include "scene/ortho_view.h"

#include <vtkActor.h>
#include <vtkCamera.h>
#include <vtkRenderWindow.h>
#include <vtkRenderer.h>

#include <algorithm>
#include <cmath>
#include <cstring>

#include "scene/hud.h"
#include "scene/renderer_setup.h"

namespace palpa::scene {
namespace {

constexpr double kScaleBar = 0.020;  // metres
constexpr double kAway = 1.0;        // metres from the region to the eye; any will do in parallel

}  // namespace

OrthoView::OrthoView(vtkRenderWindow& window, const anatomy::Patient& patient, const Region& region,
                     Plane plane)
    : window_(window),
      plane_(plane),
      side_(patient.side),
      region_(region),
      organs_(*renderer_, patient),
      section_(skinSection(patient, region.focus_A, aspectOf(plane, patient.side).ahead_A)),
      backdrop_(*renderer_, false),
      tool_(*renderer_),
      plates_(*renderer_) {
  setUpRenderer(*renderer_, colour::kPanel);
  organs_.setStyle(SkinStyle::hidden);
  if (section_ && plane_ != Plane::frontal) renderer_->AddActor(section_);
  aimCamera();
  window_.AddRenderer(renderer_);
}

OrthoView::~OrthoView() { window_.RemoveRenderer(renderer_); }

void OrthoView::addTrail(Trail& trail) { trail_ = trail.addTo(*renderer_, 1.5); }

void OrthoView::aimCamera() {
  const Aspect aspect = aspectOf(plane_, side_);
  vtkCamera* camera = renderer_->GetActiveCamera();
  const Vec3 eye = region_.centre_A - kAway * aspect.ahead_A;
  camera->ParallelProjectionOn();
  camera->SetPosition(eye.data());
  camera->SetFocalPoint(region_.centre_A.data());
  camera->SetViewUp(aspect.up_A.data());
  camera->SetClippingRange(0.01, 2 * kAway);
}

void OrthoView::place(const Rect& where, int window_width, int window_height) {
  where_ = where;
  setViewport(*renderer_, where, window_width, window_height);
  const double aspect = static_cast<double>(where.width) / where.height;
  renderer_->GetActiveCamera()->SetParallelScale(0.5 * region_.width / aspect);
  layoutWords(window_height);
}

void OrthoView::put(const std::string& words, const TextStyle& style, int x, int y) {
  const int width = textWidth(words, style) + style.size_px * 2 / 3;
  const int height = lineHeight(style);
  const int margin = style.size_px / 3;
  x = std::clamp(x, width / 2 + margin, where_.width - width / 2 - margin);
  y = std::clamp(y, height / 2 + margin, where_.height - height / 2 - margin);
  plates_.add({x - width / 2, y - height / 2, width, height}, colour::kPlate, 3);
  words_.push_back(std::make_unique<Label>(*renderer_));
  words_.back()->set(words, style, x, y, Align::centre);
}

void OrthoView::layoutWords(int window_height) {
  const Aspect aspect = aspectOf(plane_, side_);
  const int text = textSize_px(window_height);
  const TextStyle caption{std::max(10, text * 4 / 5), true, colour::kText};
  const TextStyle letter{std::max(9, text * 3 / 4), false, colour::kText};
  const int w = where_.width, h = where_.height;
  words_.clear();
  plates_.clear();
  put(aspect.caption, caption, 0, h);  // held inside by put
  put(aspect.left, letter, 0, h / 2);
  put(aspect.right, letter, w, h / 2);
  put(aspect.top, letter, w / 2, h);
  put(aspect.bottom, letter, w / 2, 0);
  putScaleBar(letter);
}

void OrthoView::putScaleBar(const TextStyle& style) {
  const std::string words = "20 mm";
  const int bar = static_cast<int>(std::lround(kScaleBar / region_.width * where_.width));
  const int margin = style.size_px / 3, line = lineHeight(style);
  const int width = std::max(bar, textWidth(words, style)) + 2 * margin;
  const Rect plate{where_.width - width - margin, margin, width, line + margin + 2};
  plates_.add(plate, colour::kPlate, 3);
  const Rgb& ink = colour::kText;
  const int middle = plate.x + width / 2;
  plates_.add({middle - bar / 2, plate.y + margin, bar, 2}, {ink[0], ink[1], ink[2], 1}, 0);
  words_.push_back(std::make_unique<Label>(*renderer_));
  words_.back()->set(words, style, middle, plate.y + margin + 2 + line / 2, Align::centre);
}

void OrthoView::prepareStill() {
  backdrop_.hide();
  organs_.setVisible(true);
  if (section_) section_->VisibilityOn();
  tool_.hide();
  if (trail_) trail_->VisibilityOff();
  plates_.setVisible(true);
  for (const auto& words : words_) words->show();
}

void OrthoView::keepStill(const Image& window_picture) {
  Image still{where_.width, where_.height, window_picture.channels, {}};
  const std::size_t row = static_cast<std::size_t>(still.width) * still.channels;
  const int top = window_picture.height - where_.top();
  still.pixels.resize(row * still.height);
  for (int y = 0; y < still.height; ++y) {
    const std::size_t from =
        (static_cast<std::size_t>(top + y) * window_picture.width + where_.x) * still.channels;
    std::memcpy(still.pixels.data() + y * row, window_picture.pixels.data() + from, row);
  }
  backdrop_.show(still);
  organs_.setVisible(false);
  if (section_) section_->VisibilityOff();
  if (trail_) trail_->VisibilityOn();
  plates_.setVisible(false);
  for (const auto& words : words_) words->hide();
}

void OrthoView::update(const SceneState& state) {
  tool_.update(state.X_AT);
  if (state.show_tool)
    tool_.show(state.tool);
  else
    tool_.hide();
}

}  // namespace palpa::scene
