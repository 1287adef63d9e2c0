#include "scene/view/scene_view.h"

#include <vtkImageData.h>
#include <vtkNew.h>
#include <vtkPNGWriter.h>
#include <vtkRenderWindow.h>
#include <vtkRenderer.h>
#include <vtkRendererCollection.h>
#include <vtkUnsignedCharArray.h>

#include <algorithm>
#include <array>
#include <utility>
#include <vector>

#include "anatomy/base/error.h"
#include "anatomy/base/whole_file.h"
#include "scene/actors/camera_picture.h"
#include "scene/actors/surface_map.h"
#include "scene/overlay/help_plate.h"
#include "scene/overlay/hud.h"
#include "scene/overlay/label.h"
#include "scene/renderer_setup.h"
#include "scene/view/ar_view.h"
#include "scene/view/navigation.h"
#include "scene/view/ortho_view.h"
#include "scene/view/two_eyes.h"
#include "scene/window/pixels.h"

namespace palpa::scene {
namespace {
constexpr const char* kFullScreenKey = "F11";

/// Between the mark on top and the notice below.
Rect helpPanel(const Rect& view, int text_px) {
  return {view.x + text_px, view.y + 4 * text_px, std::max(1, view.width - 2 * text_px),
          std::max(1, view.height - 7 * text_px)};
}

Hud saidLast(const Hud& all) {
  Hud some;
  some.notice = all.notice;
  some.alarm = all.alarm;
  some.mark = all.mark;
  return some;
}

/// In the language of whoever looks.
Hud inWords(Hud hud) {
  for (std::string* text :
       {&hud.phase, &hud.depth, &hud.force, &hud.time, &hud.touched, &hud.overlay, &hud.notice,
        &hud.mark, &hud.marked, &hud.note, &hud.can_do})
    *text = said(*text);
  if (hud.timeline)
    for (std::string* text : {&hud.timeline->time, &hud.timeline->whole, &hud.timeline->rate})
      *text = said(*text);
  if (hud.scale)
    for (std::string* text : {&hud.scale->title, &hud.scale->low, &hud.scale->high})
      *text = said(*text);
  return hud;
}

std::vector<KeyHelp> inWords(std::vector<KeyHelp> keys) {
  for (KeyHelp& key : keys) key = {said(key.key), said(key.words)};
  return keys;
}

}  // namespace

struct SceneView::Impl {
  Impl(GlContextProvider& provider, const anatomy::Patient& patient, const ViewLayout& wanted);
  ~Impl();

  void place();
  int text_px() const { return textSize_px(size[1], layout.text_scale); }
  void paintStills();
  void show(const SceneState& state);
  void writeWords(const SceneState& state);
  void mergeEyes();
  KeyPrints keyPrints() const { return input ? input->prints() : KeyPrints(); }

  GlContextProvider& context;
  vtkRenderWindow& window;
  ViewLayout layout;
  Region region;
  vtkNew<vtkRenderer> frame;  // whole window, behind: borders, and what the picture leaves free
  Plates margins;
  vtkNew<vtkRenderer> words;   // whole window, in front
  vtkNew<vtkRenderer> merged;  // alone: both eyes' picture
  Backdrop merged_backdrop{*merged, false};
  Image merged_picture;
  Trail trail;
  ArView ar;
  std::vector<std::unique_ptr<OrthoView>> fixed;
  std::unique_ptr<CameraInset> inset;  // null: none
  HudPainter hud;
  HelpPlate help;
  std::unique_ptr<HudPainter> other_hud;  // before the right eye of a headset
  Navigation navigation;
  std::unique_ptr<WindowInput> input;
  EyeCopier copier{window};
  Panels panels;
  std::array<int, 2> size{0, 0};
  bool turn_full = false;  ///< to full screen or back, with the next frame
};

SceneView::Impl::Impl(GlContextProvider& provider, const anatomy::Patient& patient,
                      const ViewLayout& wanted)
    : context(provider),
      window(*provider.window()),
      layout(wanted),
      region(regionOf(patient)),
      margins(*frame),
      ar((window.AddRenderer(frame), window), patient, region, layout),
      hud(*words, layout.force_colours),
      help(*words) {
  if (!context.interactive()) window.SetSize(layout.width, layout.height);
  window.SetNumberOfLayers(3);
  if (layout.see_through) window.SetAlphaBitPlanes(1);
  setUpRenderer(*frame, layout.see_through ? colour::kClear : colour::kBorder);
  if (layout.see_through) frame->SetBackgroundAlpha(0);
  setUpRenderer(*words, colour::kBorder);
  if (layout.stereo == Stereo::headset)
    other_hud = std::make_unique<HudPainter>(*words, layout.force_colours);
  words->SetLayer(2);
  ar.addTrail(trail);
  if (layout.fixed_views != FixedViews::none) {
    for (Plane plane : {Plane::frontal, Plane::sagittal, Plane::axial}) {
      fixed.push_back(std::make_unique<OrthoView>(window, patient, region, plane, layout.inside));
      fixed.back()->addTrail(trail);
    }
  }
  if (layout.inset == Inset::camera) inset = std::make_unique<CameraInset>(window);
  window.AddRenderer(words);
  setUpRenderer(*merged, colour::kBorder);
  merged->DrawOff();
  if (isMerged(layout.stereo)) window.AddRenderer(merged);
}

SceneView::Impl::~Impl() {
  input.reset();
  if (isMerged(layout.stereo)) window.RemoveRenderer(merged);
  window.RemoveRenderer(words);
  window.RemoveRenderer(frame);
}

void SceneView::Impl::place() {
  const int* now = window.GetSize();
  if (size[0] == now[0] && size[1] == now[1]) return;
  size = {now[0], now[1]};
  panels = layoutPanels(size[0], size[1], layout.fixed_views);
  ar.place(panels.ar, size[0], size[1]);
  const Rgb& dark = colour::kPanel;
  margins.clear();
  if (layout.stereo != Stereo::headset) margins.add(panels.ar, {dark[0], dark[1], dark[2], 1}, 0);
  const Rect* places[] = {&panels.front, &panels.side, &panels.top};
  for (std::size_t i = 0; i < fixed.size(); ++i)
    fixed[i]->place(*places[i], size[0], size[1], text_px());
  paintStills();
}

/// Where one is shown at a time they lie over each other, and each is painted alone.
/// Nobody sees that: the window shows the next whole frame.
void SceneView::Impl::paintStills() {
  const int shows = window.GetSwapBuffers();
  window.SetSwapBuffers(0);
  words->DrawOff();
  for (std::size_t i = 0; i < fixed.size(); ++i) {
    for (std::size_t other = 0; other < fixed.size(); ++other) fixed[other]->setDrawn(other == i);
    fixed[i]->prepareStill();
    window.Render();
    fixed[i]->keepStill(pixelsOf(window));
  }
  for (const auto& view : fixed) view->setDrawn(true);
  words->DrawOn();
  window.SetSwapBuffers(shows);
}

void SceneView::Impl::show(const SceneState& state) {
  if (std::exchange(turn_full, false))
    context.setFullScreen(!context.place().value_or(WindowPlace{}).full_screen);
  place();
  trail.update(state.trail_A);
  ar.update(state);
  for (std::size_t i = 0; i < fixed.size(); ++i) {
    fixed[i]->setDrawn(layout.fixed_views == FixedViews::three ||
                       i == static_cast<std::size_t>(state.fixed_view));
    fixed[i]->update(state);
  }
  Rect free = panels.ar;
  if (state.hud.timeline) free.y += stripHeight_px(text_px()) + text_px() / 2;
  if (inset) inset->show(state.beside ? state.beside : state.picture, free, size[0], size[1]);
  writeWords(state);
  window.Render();
  if (isMerged(layout.stereo)) mergeEyes();
}

void SceneView::Impl::writeWords(const SceneState& state) {
  const std::vector<ForceArrow> forces =
      ar.showsPatient() ? state.forces : std::vector<ForceArrow>();
  const KeyPrints prints = keyPrints();
  Hud text = withKeys(state.hud, prints);
  // Over the keys stands nothing else but what was said last.
  if (!state.help.empty()) text = saidLast(text);
  std::vector<KeyHelp> keys = state.help;
  for (KeyHelp& row : keys) row.key = withKeys(row.key, prints);
  help.update(inWords(keys), helpPanel(panels.ar, text_px()), text_px());
  if (ar.showsPatient() && state.surface_map) text.scale = scaleOf(*state.surface_map);
  text = inWords(std::move(text));
  Surroundings around = ar.toolOnScreen(state, 0);
  if (isMerged(layout.stereo)) around.add(ar.toolOnScreen(state, 1));
  if (!other_hud) return hud.update(text, forces, panels.ar, text_px(), around);
  // The same words at the same places of both: they make way for what either eye sees.
  const std::array<Rect, 2> where = wordPanels(ar.eyes(), ar.panelsOfEyes());
  const Eigen::Vector2d to_left(where[0].x - where[1].x, where[0].y - where[1].y);
  around.add(ar.toolOnScreen(state, 1).movedBy(to_left));
  const int eyes_text_px = textSize_px(2 * where[0].height);
  hud.update(text, forces, where[0], eyes_text_px, around);
  other_hud->update(text, forces, where[1], eyes_text_px, around.movedBy(-to_left));
}

/// Both eyes one after the other, and then their one picture over the whole window.
void SceneView::Impl::mergeEyes() {
  const Image left = pixelsOf(window);
  ar.showEye(1);
  window.Render();
  merged_picture = scene::merged(left, pixelsOf(window), layout.stereo);
  merged_backdrop.show(merged_picture);
  std::vector<vtkRenderer*> others;
  for (int i = 0; i < window.GetRenderers()->GetNumberOfItems(); ++i) {
    auto* renderer = static_cast<vtkRenderer*>(window.GetRenderers()->GetItemAsObject(i));
    if (!renderer->GetDraw() || renderer == merged.Get()) continue;
    renderer->DrawOff();
    others.push_back(renderer);
  }
  merged->DrawOn();
  window.Render();
  merged->DrawOff();
  for (vtkRenderer* renderer : others) renderer->DrawOn();
}

SceneView::SceneView(GlContextProvider& context, const anatomy::Patient& patient,
                     const ViewLayout& layout)
    : impl_(std::make_unique<Impl>(context, patient, layout)) {
  SceneState first;  // compiles the shaders, so that the first real frame is not late
  first.show_tool = false;
  show(first);
  if (context.interactive()) impl_->input = std::make_unique<WindowInput>(impl_->window);
}

SceneView::~SceneView() = default;

void SceneView::show(const SceneState& state) { impl_->show(state); }

Image SceneView::capture() const { return pixelsOf(impl_->window); }

void SceneView::copyEye(std::size_t eye, const TextureTarget& target) const {
  impl_->copier.copy(impl_->ar.panelsOfEyes().at(eye), target);
}

ViewInput SceneView::poll() {
  if (!impl_->input) return {};
  ViewInput input = impl_->input->poll();
  // With the next frame: the window system may take its time, and other keys are not to wait.
  if (std::count(input.keys.begin(), input.keys.end(), kFullScreenKey) % 2 == 1)
    impl_->turn_full = !impl_->turn_full;
  const auto [width, height] = impl_->size;
  const Eigen::Vector2d mouse =
      inEyesPicture({input.mouse_x, input.mouse_y}, width, height, impl_->layout.stereo);
  input.mouse_x = mouse.x();
  input.mouse_y = mouse.y();
  if (impl_->layout.free_navigation && impl_->ar.isVirtual())
    impl_->navigation.apply(input, impl_->ar.picture(), impl_->size[1], impl_->ar.orbit());
  return input;
}

KeyPrints SceneView::keyPrints() const { return impl_->keyPrints(); }

ArGeometry SceneView::arGeometry(std::size_t of) const {
  const Rect& picture = impl_->ar.eyePanel(of);
  const double top = impl_->size[1] - picture.top();
  EyeCamera eye = impl_->ar.eye(of);
  eye.camera.cx += picture.x;
  eye.camera.cy += top;
  return {eye.camera,
          eye.X_CA,
          static_cast<double>(picture.x),
          top,
          static_cast<double>(picture.width),
          static_cast<double>(picture.height)};
}

std::vector<Rect> SceneView::wordPlates() const {
  std::vector<Rect> plates = impl_->hud.plates();
  if (!impl_->other_hud) return plates;
  const std::vector<Rect> others = impl_->other_hud->plates();
  plates.insert(plates.end(), others.begin(), others.end());
  return plates;
}

void SceneView::resetNavigation() { impl_->ar.orbit().reset(); }

namespace {

void checkWritable(const Image& image, const std::string& file) {
  const auto expected = static_cast<std::size_t>(image.width) * image.height * image.channels;
  const bool sized = image.width > 0 && image.height > 0;
  if (!sized || (image.channels != 1 && image.channels != 3) || image.pixels.size() != expected)
    throw Error("the picture has no pixels, or their number does not fit its size", file,
                "Capture a frame after the first SceneView::show");
}

vtkNew<vtkImageData> toVtk(const Image& image) {
  vtkNew<vtkImageData> result;
  result->SetDimensions(image.width, image.height, 1);
  result->AllocateScalars(VTK_UNSIGNED_CHAR, image.channels);
  const std::size_t row = static_cast<std::size_t>(image.width) * image.channels;
  copyFlipped(image.pixels.data(), static_cast<std::uint8_t*>(result->GetScalarPointer()), row,
              image.height);
  return result;
}

[[noreturn]] void refuse(const std::string& file) {
  throw Error("the picture cannot be written", file,
              "Check that the folder exists, can be written and has free space");
}

}  // namespace

void writePng(const Image& image, const std::string& file) {
  checkWritable(image, file);
  vtkNew<vtkPNGWriter> writer;
  writer->SetInputData(toVtk(image));
  writer->WriteToMemoryOn();
  writer->Write();
  vtkUnsignedCharArray* bytes = writer->GetResult();
  try {
    writeWhole(file, {reinterpret_cast<const char*>(bytes->GetPointer(0)),
                      static_cast<std::size_t>(bytes->GetNumberOfValues())});
  } catch (const Error&) {
    refuse(file);
  }
}

}  // namespace palpa::scene
