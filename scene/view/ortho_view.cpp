#include "scene/view/ortho_view.h"

#include <vtkActor.h>
#include <vtkCamera.h>
#include <vtkRenderWindow.h>
#include <vtkRenderer.h>

#include <algorithm>
#include <cmath>
#include <cstring>

#include "scene/overlay/hud.h"
#include "scene/overlay/label.h"
#include "scene/renderer_setup.h"

namespace palpa::scene {
namespace {

constexpr double kScaleBar = 0.020;  // metres
constexpr double kAway = 1.0;        // metres from the region to the eye; any will do in parallel
constexpr double kFarAway = 100;     // metres: from there a view is as good as parallel
constexpr double kPinSmall_px = 6;   // a pin's head in a window 720 pixels high

}  // namespace

OrthoView::OrthoView(vtkRenderWindow& window, const anatomy::Patient& patient, const Region& region,
                     Plane plane, bool inside)
    : window_(window),
      plane_(plane),
      region_(region),
      aspect_(region.on_table ? aspectOnTable(plane) : aspectOf(plane, patient.side)),
      inside_(inside),
      organs_(*renderer_, patient),
      section_(inside ? sectionOf(patient) : nullptr),
      backdrop_(*renderer_, false),
      search_(*renderer_, *renderer_, 1.6),
      tool_(*renderer_),
      other_probe_(*renderer_),
      plates_(*renderer_) {
  setUpRenderer(*renderer_, colour::kPanel);
  organs_.setInside(inside);
  organs_.setStyle(!inside             ? SkinStyle::solid
                   : region_.only_skin ? SkinStyle::translucent
                                       : SkinStyle::hidden);
  if (section_) renderer_->AddActor(section_);
  aimCamera();
  window_.AddRenderer(renderer_);
}

OrthoView::~OrthoView() { window_.RemoveRenderer(renderer_); }

void OrthoView::setDrawn(bool drawn) { renderer_->SetDraw(drawn); }

void OrthoView::addTrail(Trail& trail) { trail_ = trail.addTo(*renderer_, 1.5); }

/// From the front a section tells nothing of depth; a skin alone gets its outline.
vtkSmartPointer<vtkActor> OrthoView::sectionOf(const anatomy::Patient& patient) const {
  if (region_.only_skin) return skinSection(patient, region_.whole_centre_A, aspect_.ahead_A);
  return plane_ == Plane::frontal ? nullptr
                                  : skinSection(patient, region_.focus_A, aspect_.ahead_A);
}

double OrthoView::metresAcross() const {
  return std::max(region_.width, region_.height * where_.width / where_.height);
}

void OrthoView::aimCamera() {
  vtkCamera* camera = renderer_->GetActiveCamera();
  const Vec3 eye = region_.centre_A - kAway * aspect_.ahead_A;
  camera->ParallelProjectionOn();
  camera->SetPosition(eye.data());
  camera->SetFocalPoint(region_.centre_A.data());
  camera->SetViewUp(aspect_.up_A.data());
  camera->SetClippingRange(0.01, 2 * kAway);
}

void OrthoView::place(const Rect& where, int window_width, int window_height, int text_px) {
  where_ = where;
  setViewport(*renderer_, where, window_width, window_height);
  window_height_ = window_height;
  renderer_->GetActiveCamera()->SetParallelScale(0.5 * metresAcross() * where.height / where.width);
  layoutWords(text_px);
}

void OrthoView::put(const std::string& words, const TextStyle& style, int x, int y) {
  if (words.empty()) return;
  const std::string text = said(words);
  const int width = textWidth(text, style) + style.size_px * 2 / 3;
  const int height = lineHeight(style);
  const int margin = style.size_px / 3;
  x = std::max(std::min(x, where_.width - width / 2 - margin), width / 2 + margin);
  y = std::max(std::min(y, where_.height - height / 2 - margin), height / 2 + margin);
  const Rect plate{x - width / 2, y - height / 2, width, height};
  if (!claim(plate)) return;
  plates_.add(plate, colour::kPlate, 3);
  words_.push_back(std::make_unique<Label>(*renderer_));
  words_.back()->set(text, style, x, y, Align::centre);
}

void OrthoView::layoutWords(int text) {
  const TextStyle caption{std::max(kSmallestText_px, text * 4 / 5), true, colour::kText};
  const TextStyle letter{std::max(kSmallestText_px, text * 3 / 4), false, colour::kText};
  const int w = where_.width, h = where_.height;
  words_.clear();
  plates_.clear();
  claimed_.clear();
  putScaleBar(letter);
  put(aspect_.caption, caption, 0, h);  // held inside by put
  put(aspect_.left, letter, 0, h / 2);
  put(aspect_.right, letter, w, h / 2);
  put(aspect_.top, letter, w / 2, h);
  put(aspect_.bottom, letter, w / 2, 0);
}

/// Words that have no room, or would lie over others, are left out.
bool OrthoView::claim(const Rect& plate) {
  const bool has_room =
      plate.x >= 0 && plate.y >= 0 && plate.right() <= where_.width && plate.top() <= where_.height;
  const bool taken = std::any_of(claimed_.begin(), claimed_.end(), [&](const Rect& other) {
    return plate.x < other.right() && other.x < plate.right() && plate.y < other.top() &&
           other.y < plate.top();
  });
  if (!has_room || taken) return false;
  claimed_.push_back(plate);
  return true;
}

void OrthoView::putScaleBar(const TextStyle& style) {
  const std::string words = "20 mm";
  const int bar = static_cast<int>(std::lround(kScaleBar / metresAcross() * where_.width));
  const int margin = style.size_px / 3, line = lineHeight(style);
  const int width = std::max(bar, textWidth(words, style)) + 2 * margin;
  const Rect plate{where_.width - width - margin, margin, width, line + margin + 2};
  if (!claim(plate)) return;
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
  other_probe_.hide();
  search_.update({}, false, {}, 1);
  if (trail_) trail_->VisibilityOff();
  plates_.setVisible(true);
  for (const auto& words : words_) words->show();
}

void OrthoView::keepStill(const Image& window_picture) {
  if (trail_) trail_->VisibilityOn();
  if (!inside_) return;
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
  plates_.setVisible(false);
  for (const auto& words : words_) words->hide();
}

Sight OrthoView::sight() const {
  Mat3 R_AC;
  R_AC << aspect_.ahead_A.cross(aspect_.up_A), -aspect_.up_A, aspect_.ahead_A;
  return {makePose(R_AC, region_.centre_A - kFarAway * aspect_.ahead_A).inverse(),
          kFarAway * where_.width / metresAcross(), 0.5 * kAway};
}

void OrthoView::update(const SceneState& state) {
  search_.update(state, true, sight(), kPinSmall_px * window_height_ / 720.0);
  tool_.update(state.X_AT);
  other_probe_.update(state.second_X_AT.value_or(state.X_AT));
  if (state.show_tool)
    tool_.show(state.tool);
  else
    tool_.hide();
  if (state.show_tool && state.second_X_AT)
    other_probe_.show(Tool::probe);
  else
    other_probe_.hide();
}

}  // namespace palpa::scene
