#include "scene/inset.h"

#include <vtkRenderWindow.h>
#include <vtkRenderer.h>

#include "scene/palette.h"
#include "scene/renderer_setup.h"

namespace palpa::scene {
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

}  // namespace palpa::scene
