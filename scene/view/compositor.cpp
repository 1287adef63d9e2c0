#include "scene/view/compositor.h"

#include <vtkNew.h>
#include <vtkObjectFactory.h>
#include <vtkOpenGLFramebufferObject.h>
#include <vtkOpenGLQuadHelper.h>
#include <vtkOpenGLRenderWindow.h>
#include <vtkOpenGLShaderCache.h>
#include <vtkProp.h>
#include <vtkRenderer.h>
#include <vtkShaderProgram.h>
#include <vtkTextureObject.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <random>
#include <vector>

#include "scene/actors/camera_picture.h"
#include "scene/view/compositor_glsl.h"
#include "scene/view/creases.h"
#include "scene/view/flat_pass.h"

namespace palpa::scene {
namespace {

constexpr int kTile = 128;            // pixels of the camera, a side of the tile of grain
constexpr double kTileUnit = 40;      // of 255: one standard deviation
constexpr double kLeastSpan = 0.4;    // between the levels of black and of white
constexpr double kSmoothing = 0.40;   // px: what a smoothed edge adds to a Gaussian's sigma
constexpr double kLeastBlur = 0.25;   // px; less is not seen
constexpr double kWidestBlur = 3.2;   // px; that the pairs below can hold
constexpr double kBetween = 1.0 / 6;  // px^2: what reading between pixels adds to a blur's square

/// A Gaussian's weights, two pixels to a look-up: the middle, then pairs outward.
struct Kernel {
  int pairs = 0;
  std::array<float, 5> place{}, weight{};
};

Kernel kernelOf(double sigma) {
  // Samples of a narrow Gaussian are narrower than it; three pixels of its variance rise later,
  // with a longer foot: the narrower it is, the more between the two.
  const double square = sigma * sigma, sampled = std::exp(-0.5 / square);
  const double same_variance = 0.5 * square / (1 - square);
  const double between = std::clamp((0.6 - sigma) / 0.15, 0.0, 0.5);
  const double beside = std::lerp(sampled, same_variance, between);
  const auto bell = [&](int i) {
    return sigma < 0.6 ? (i < 2 ? beside : 0) : std::exp(-0.5 * i * i / square);
  };
  Kernel kernel;
  kernel.pairs = std::clamp(static_cast<int>(std::ceil(1.25 * sigma)), 1, 4);
  double sum = 1;
  kernel.weight[0] = 1;
  for (int k = 1; k <= kernel.pairs; ++k) {
    const double near = bell(2 * k - 1), far = bell(2 * k), both = near + far;
    kernel.place[k] = static_cast<float>(both > 0 ? 2 * k - 1 + far / both : 2 * k - 1);
    kernel.weight[k] = static_cast<float>(both);
    sum += 2 * both;
  }
  for (float& weight : kernel.weight) weight = static_cast<float>(weight / sum);
  return kernel;
}

/// Noise of which neighbours are alike to this degree: each value is one of white noise and a share
/// of the next, along rows and along columns.
std::vector<std::uint8_t> grainTile(double neighbours) {
  const double alike = std::clamp(neighbours, 0.0, 0.49);
  const double share = alike > 0 ? (1 - std::sqrt(1 - 4 * alike * alike)) / (2 * alike)
                                 : 0;  // alike = s / (1 + s^2)
  std::mt19937 bits(1);
  std::normal_distribution<double> normal;
  const auto index = [](int row, int column, int k) {
    return static_cast<std::size_t>(((row % kTile) * kTile + column % kTile) * 3 + k);
  };
  std::vector<double> white(std::size_t{3} * kTile * kTile);
  for (double& value : white) value = normal(bits);
  std::vector<std::uint8_t> tile(white.size());
  const double unit = kTileUnit / (1 + share * share);
  for (int row = 0; row < kTile; ++row)
    for (int column = 0; column < kTile; ++column)
      for (int k = 0; k < 3; ++k) {
        const double value =
            white[index(row, column, k)] + share * white[index(row, column + 1, k)] +
            share *
                (white[index(row + 1, column, k)] + share * white[index(row + 1, column + 1, k)]);
        tile[index(row, column, k)] =
            static_cast<std::uint8_t>(std::clamp(std::lround(128 + unit * value), 0L, 255L));
      }
  return tile;
}

/// In a dark picture, or a pale one, an overlay as dark or as pale would not be seen.
CameraLook legible(CameraLook look) {
  double span = 0;
  for (std::size_t k = 0; k < 3; ++k) span += (look.white[k] - look.black[k]) / 3;
  if (span >= kLeastSpan) return look;
  for (std::size_t k = 0; k < 3; ++k) {
    const double more = kLeastSpan - span;
    const double down = std::min(look.black[k], 0.5 * more);
    look.black[k] -= down;
    look.white[k] = std::min(look.white[k] + more - down, 1.0);
  }
  return look;
}

}  // namespace

/// Drawn by VTK after everything else of its renderer.
class Compositor::Pass : public vtkProp {
 public:
  static Pass* New();
  vtkTypeMacro(Pass, vtkProp);

  void show(const Image* picture, const CameraLook& look, bool smooth);
  void shadeCreases() { creases_ = std::make_unique<Creases>(); }
  int RenderOverlay(vtkViewport* viewport) override;
  void ReleaseGraphicsResources(vtkWindow* window) override;

 private:
  void prepare(vtkOpenGLRenderWindow& window, int width, int height);
  void smoothApart(vtkOpenGLRenderWindow& window, vtkTextureObject& drawn);
  void compose(vtkOpenGLRenderWindow& window, vtkTextureObject& drawn, double blur_px, int width,
               int height);
  double blurIn(int width) const;

  Image picture_;  ///< none: width 0
  bool fresh_ = false, smooth_edges_ = true;
  CameraLook look_;
  double tile_neighbours_ = -1;
  std::array<float, 2> grain_place_{};
  std::mt19937 places_{2};
  vtkNew<vtkTextureObject> drawn_, smooth_, camera_, grain_;
  vtkNew<vtkOpenGLFramebufferObject> apart_;
  FlatQuad smooth_only_, jagged_, sharp_, blurred_;
  std::unique_ptr<Creases> creases_;  ///< null: they are as light as all else
};
vtkStandardNewMacro(Compositor::Pass);

void Compositor::Pass::show(const Image* picture, const CameraLook& look, bool smooth) {
  look_ = legible(look);
  smooth_edges_ = smooth;
  if (!picture) {
    picture_ = {};
    return;
  }
  checkPicture(*picture);
  if (picture_.width == picture->width && picture_.height == picture->height &&
      picture_.pixels == picture->pixels)
    return;
  picture_ = *picture;
  fresh_ = true;
  std::uniform_int_distribution<int> anywhere(0, kTile - 1);  // whole pixels: between them is less
  for (float& place : grain_place_) place = static_cast<float>(anywhere(places_)) / kTile;
}

void Compositor::Pass::prepare(vtkOpenGLRenderWindow& window, int width, int height) {
  if (!smooth_only_) {
    using namespace glsl;
    smooth_only_ = flatQuad(window, {kBegin, kSmooth, kSmoothOnly});
    jagged_ = flatQuad(window, {kBegin, kJagged, kOver});
    sharp_ = flatQuad(window, {kBegin, kSmooth, kSharp, kOver});
    blurred_ = flatQuad(window, {kBegin, kBlur, kOver});
    for (vtkTextureObject* texture : {drawn_.Get(), smooth_.Get(), camera_.Get()})
      keepInside(*texture, window, vtkTextureObject::ClampToEdge);
    keepInside(*grain_, window, vtkTextureObject::Repeat);
    apart_->SetContext(&window);
  }
  fit(*drawn_, width, height);
  if (picture_.width == 0) return;
  if (std::abs(tile_neighbours_ - look_.grain_neighbours) > 0.02) {
    std::vector<std::uint8_t> tile = grainTile(look_.grain_neighbours);
    grain_->Create2DFromRaw(kTile, kTile, 3, VTK_UNSIGNED_CHAR, tile.data());
    tile_neighbours_ = look_.grain_neighbours;
  }
  if (!fresh_ && camera_->GetHandle() != 0) return;
  camera_->Create2DFromRaw(static_cast<unsigned int>(picture_.width),
                           static_cast<unsigned int>(picture_.height), picture_.channels,
                           VTK_UNSIGNED_CHAR, picture_.pixels.data());
  fresh_ = false;
}

/// Pixels of the frame, besides what smoothing has done.
double Compositor::Pass::blurIn(int width) const {
  if (picture_.width == 0) return 0;
  const double scale = static_cast<double>(width) / picture_.width;
  const double shown = look_.blur_px * look_.blur_px + (width == picture_.width ? 0 : kBetween);
  const double left = look_.blur_px > 0 ? scale * scale * shown - kSmoothing * kSmoothing : 0;
  return left < kLeastBlur * kLeastBlur ? 0 : std::min(std::sqrt(left), kWidestBlur);
}

void Compositor::Pass::smoothApart(vtkOpenGLRenderWindow& window, vtkTextureObject& drawn) {
  const auto width = static_cast<int>(drawn.GetWidth()),
             height = static_cast<int>(drawn.GetHeight());
  fit(*smooth_, width, height);
  drawInto(*smooth_, *apart_, window, [&] {
    window.GetShaderCache()->ReadyShaderProgram(smooth_only_->Program);
    drawn.Activate();
    const float texel[] = {1.0F / static_cast<float>(width), 1.0F / static_cast<float>(height)};
    smooth_only_->Program->SetUniformi("drawn", drawn.GetTextureUnit());
    smooth_only_->Program->SetUniform2f("texel", texel);
    smooth_only_->Render();
    drawn.Deactivate();
  });
}

void Compositor::Pass::compose(vtkOpenGLRenderWindow& window, vtkTextureObject& drawn,
                               double blur_px, int width, int height) {
  vtkOpenGLQuadHelper& quad = blur_px > 0 ? *blurred_ : smooth_edges_ ? *sharp_ : *jagged_;
  vtkShaderProgram& program = *quad.Program;
  window.GetShaderCache()->ReadyShaderProgram(&program);
  drawn.Activate();
  const float texel[] = {1.0F / static_cast<float>(width), 1.0F / static_cast<float>(height)};
  program.SetUniformi("drawn", drawn.GetTextureUnit());
  program.SetUniform2f("texel", texel);
  program.SetUniformi("channels", picture_.width == 0 ? 0 : picture_.channels);
  if (blur_px > 0) {
    const Kernel kernel = kernelOf(blur_px);
    program.SetUniformi("pairs", kernel.pairs);
    program.SetUniformf("reach", static_cast<float>(1.5 * blur_px));
    program.SetUniform1fv("place", 5, kernel.place.data());
    program.SetUniform1fv("weight", 5, kernel.weight.data());
  }
  if (picture_.width > 0) {
    camera_->Activate();
    grain_->Activate();
    program.SetUniformi("picture", camera_->GetTextureUnit());
    program.SetUniformi("grain", grain_->GetTextureUnit());
    const float scale[] = {static_cast<float>(picture_.width) / kTile,
                           static_cast<float>(picture_.height) / kTile};
    program.SetUniform2f("grain_scale", scale);
    program.SetUniform2f("grain_place", grain_place_.data());
    program.SetUniform3f("black", look_.black.data());
    program.SetUniform3f("white", look_.white.data());
    std::array<float, 5> strength{};
    std::copy(look_.grain.begin(), look_.grain.end(), strength.begin());
    program.SetUniform1fv("grain_strength", 5, strength.data());
    program.SetUniformf("grain_colour", static_cast<float>(look_.grain_colour));
    program.SetUniformf("grain_unit", static_cast<float>(255 / kTileUnit));
  }
  quad.Render();
  if (picture_.width > 0) {
    grain_->Deactivate();
    camera_->Deactivate();
  }
  drawn.Deactivate();
}

int Compositor::Pass::RenderOverlay(vtkViewport* viewport) {
  auto& renderer = *static_cast<vtkRenderer*>(viewport);
  auto& window = *static_cast<vtkOpenGLRenderWindow*>(renderer.GetRenderWindow());
  int width = 0, height = 0, left = 0, bottom = 0;
  renderer.GetTiledSizeAndOrigin(&width, &height, &left, &bottom);
  if (width <= 0 || height <= 0) return 0;
  prepare(window, width, height);
  const FlatDrawing flat(window.GetState());
  drawn_->CopyFromFrameBuffer(left, bottom, 0, 0, width, height);
  vtkTextureObject* drawn = drawn_;
  if (creases_) drawn = &creases_->shade(*drawn, {left, bottom, width, height}, renderer);
  const double blur_px = blurIn(width);
  const bool apart = blur_px > 0 && smooth_edges_;
  if (apart) smoothApart(window, *drawn);
  compose(window, apart ? *smooth_ : *drawn, blur_px, width, height);
  return 1;
}

void Compositor::Pass::ReleaseGraphicsResources(vtkWindow* window) {
  for (vtkTextureObject* texture : {drawn_.Get(), smooth_.Get(), camera_.Get(), grain_.Get()})
    texture->ReleaseGraphicsResources(window);
  apart_->ReleaseGraphicsResources(window);
  for (FlatQuad* quad : {&smooth_only_, &jagged_, &sharp_, &blurred_}) {
    if (*quad) (*quad)->ReleaseGraphicsResources(window);
    quad->reset();
  }
  if (creases_) creases_->release(window);
  tile_neighbours_ = -1;
  fresh_ = picture_.width > 0;
  Superclass::ReleaseGraphicsResources(window);
}

Compositor::Compositor(vtkRenderer& last)
    : renderer_(last), pass_(Pass::New(), [](Pass* pass) { pass->Delete(); }) {
  renderer_.AddViewProp(pass_.get());
}

void Compositor::shadeCreases() { pass_->shadeCreases(); }

Compositor::~Compositor() { renderer_.RemoveViewProp(pass_.get()); }

void Compositor::show(const Image* picture, const CameraLook& look, bool smooth) {
  pass_->show(picture, look, smooth);
}

void Compositor::setOn(bool on) { pass_->SetVisibility(on); }

}  // namespace palpa::scene
