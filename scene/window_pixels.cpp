#include "scene/window_pixels.h"

#include <vtkNew.h>
#include <vtkRenderWindow.h>
#include <vtkUnsignedCharArray.h>

#include "anatomy/geometry/error.h"
#include "scene/image_rows.h"

namespace palpa::scene {

Image pixelsOf(vtkRenderWindow& window) {
  const int* size = window.GetSize();
  Image image{size[0], size[1], 3, {}};
  vtkNew<vtkUnsignedCharArray> pixels;
  if (window.GetPixelData(0, 0, image.width - 1, image.height - 1, 0, pixels, 0) == VTK_ERROR)
    throw Error("the frame cannot be read back", "scene", "Update the graphics driver");
  const std::size_t row = static_cast<std::size_t>(image.width) * 3;
  image.pixels.resize(row * image.height);
  copyFlipped(pixels->GetPointer(0), image.pixels.data(), row, image.height);
  return image;
}

}  // namespace palpa::scene
