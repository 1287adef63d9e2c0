#include "scene/actors/camera_picture.h"

#include <vtkActor.h>
#include <vtkImageData.h>
#include <vtkMatrix4x4.h>
#include <vtkNew.h>
#include <vtkPolyData.h>
#include <vtkPolyDataMapper.h>
#include <vtkProp.h>
#include <vtkPropCollection.h>
#include <vtkRenderWindow.h>
#include <vtkRenderer.h>
#include <vtkSmartPointer.h>
#include <vtkTexture.h>

#include <string>

#include "anatomy/base/error.h"
#include "scene/actors/instrument.h"
#include "scene/actors/organ_actors.h"
#include "scene/palette.h"
#include "scene/renderer_setup.h"
#include "scene/window/pixels.h"

namespace palpa::scene {

void checkPicture(const Image& picture) {
  const bool sized = picture.width > 0 && picture.height > 0;
  const bool known = picture.channels == 1 || picture.channels == 3;
  const auto expected = static_cast<std::size_t>(picture.width) * picture.height * picture.channels;
  if (!sized || !known || picture.pixels.size() != expected)
    throw Error("a picture of " + std::to_string(picture.width) + " x " +
                    std::to_string(picture.height) + " x " + std::to_string(picture.channels) +
                    " has " + std::to_string(picture.pixels.size()) + " bytes",
                "camera picture", "Give width * height * channels bytes, gray or RGB");
}

Backdrop::Backdrop(vtkRenderer& renderer, bool smooth) : renderer_(renderer) {
  texture_->SetInputData(image_);
  texture_->SetInterpolate(smooth);
  texture_->RepeatOff();
  texture_->EdgeClampOn();
}

Backdrop::~Backdrop() = default;

void Backdrop::show(const Image& picture) {
  checkPicture(picture);
  const int* size = image_->GetDimensions();
  if (size[0] != picture.width || size[1] != picture.height ||
      image_->GetNumberOfScalarComponents() != picture.channels) {
    image_->SetDimensions(picture.width, picture.height, 1);
    image_->AllocateScalars(VTK_UNSIGNED_CHAR, picture.channels);
  }
  const std::size_t row = static_cast<std::size_t>(picture.width) * picture.channels;
  copyFlipped(picture.pixels.data(), static_cast<std::uint8_t*>(image_->GetScalarPointer()), row,
              picture.height);
  image_->Modified();
  renderer_.SetBackgroundTexture(texture_);
  renderer_.TexturedBackgroundOn();
}

void Backdrop::hide() { renderer_.TexturedBackgroundOff(); }

namespace {

constexpr double kShare = 0.26;  // of the panel's width
constexpr int kEdge_px = 2, kMargin_px = 10;

/// Over the large view, and not blended with it.
void layOver(vtkRenderWindow& window, vtkRenderer& renderer) {
  setUpRenderer(renderer, colour::kText);
  renderer.SetLayer(1);
  renderer.SetPreserveColorBuffer(0);
  renderer.DrawOff();
  window.AddRenderer(&renderer);
}

}  // namespace

Rect insetRect(const Rect& panel, int picture_width, int picture_height) {
  const int width = static_cast<int>(kShare * panel.width),
            height = width * picture_height / picture_width;
  return {panel.right() - kMargin_px - width, panel.y + kMargin_px, width, height};
}

CameraInset::CameraInset(vtkRenderWindow& window) : window_(window), backdrop_(*picture_, true) {
  layOver(window_, *frame_);
  layOver(window_, *picture_);
}

CameraInset::~CameraInset() {
  window_.RemoveRenderer(picture_);
  window_.RemoveRenderer(frame_);
}

void CameraInset::show(const Image* picture, const Rect& panel, int window_width,
                       int window_height) {
  frame_->SetDraw(picture != nullptr);
  picture_->SetDraw(picture != nullptr);
  if (!picture) return;
  const Rect edge = insetRect(panel, picture->width, picture->height);
  setViewport(*frame_, edge, window_width, window_height);
  setViewport(
      *picture_,
      {edge.x + kEdge_px, edge.y + kEdge_px, edge.width - 2 * kEdge_px, edge.height - 2 * kEdge_px},
      window_width, window_height);
  backdrop_.show(*picture);
}

struct Occluders::Thing {
  const anatomy::TriangleMesh* mesh = nullptr;
  vtkNew<vtkActor> actor;
  vtkSmartPointer<vtkPolyDataMapper> mapper = makePassMapper();
  vtkNew<vtkMatrix4x4> X_A;
};

Occluders::Occluders(vtkRenderer& renderer) : renderer_(renderer) {}
Occluders::~Occluders() = default;

void Occluders::update(const std::vector<Occluder>& things, bool picture) {
  while (things_.size() < things.size()) {
    things_.push_back(std::make_unique<Thing>());
    Thing& thing = *things_.back();
    setWrites(*thing.mapper, false, true);
    thing.actor->SetMapper(thing.mapper);
    thing.actor->SetUserMatrix(thing.X_A);
    // In front of all others, which VTK draws in the order in which they came.
    vtkNew<vtkPropCollection> others;
    vtkPropCollection* now = renderer_.GetViewProps();
    now->InitTraversal();
    while (vtkProp* prop = now->GetNextProp()) others->AddItem(prop);
    renderer_.RemoveAllViewProps();
    renderer_.AddActor(thing.actor);
    others->InitTraversal();
    while (vtkProp* prop = others->GetNextProp()) renderer_.AddViewProp(prop);
  }
  for (std::size_t i = 0; i < things_.size(); ++i) {
    Thing& thing = *things_[i];
    const bool there = picture && i < things.size() && things[i].mesh;
    thing.actor->SetVisibility(there);
    if (!there) continue;
    if (thing.mesh != things[i].mesh) {
      thing.mesh = things[i].mesh;
      thing.mapper->SetInputData(polyDataOf(*thing.mesh));
    }
    copy(things[i].X_A, *thing.X_A);
  }
}

}  // namespace palpa::scene
