#include "scene/backdrop.h"

#include <vtkImageData.h>
#include <vtkRenderer.h>
#include <vtkTexture.h>

#include <string>

#include "anatomy/geometry/error.h"
#include "scene/image_rows.h"

namespace palpa::scene {
namespace {

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

}  // namespace

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

}  // namespace palpa::scene
