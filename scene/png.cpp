#include <vtkImageData.h>
#include <vtkNew.h>
#include <vtkPNGWriter.h>
#include <vtkUnsignedCharArray.h>

#include <unistd.h>

#include <filesystem>
#include <fstream>

#include "anatomy/geometry/error.h"
#include "scene/image_rows.h"
#include "scene/scene_view.h"

namespace palpa::scene {
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

[[noreturn]] void refuse(const std::string& file, const std::string& beside) {
  std::error_code ignored;
  std::filesystem::remove(beside, ignored);
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
  const vtkUnsignedCharArray* bytes = writer->GetResult();
  const std::string beside = file + "." + std::to_string(getpid()) + ".part";
  std::ofstream out(beside, std::ios::binary);
  out.write(reinterpret_cast<const char*>(const_cast<vtkUnsignedCharArray*>(bytes)->GetPointer(0)),
            bytes->GetNumberOfValues());
  out.close();
  if (!out) refuse(file, beside);
  std::error_code failure;
  std::filesystem::rename(beside, file, failure);
  if (failure) refuse(file, beside);
}

}  // namespace palpa::scene
