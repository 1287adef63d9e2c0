#include "anatomy/patient/gltf_picture.h"

#include <cstring>

#include "anatomy/base/error.h"
#include "anatomy/patient/tinygltf_png.h"

namespace palpa::anatomy {
namespace {

constexpr std::size_t kPngHeader = 33;  // signature, and the first chunk with what the picture is
constexpr std::uint32_t kMostPixels = 4096;  // a side
constexpr std::size_t kPngOverhead = 65536;  // of a picture that cannot be packed any smaller

[[noreturn]] void refusePicture(const std::string& what, const std::string& where) {
  throw Error("the picture on a surface " + what, where,
              "Write the patient again or take another file");
}

std::uint32_t bigEndian(const unsigned char* at) {
  return std::uint32_t{at[0]} << 24 | std::uint32_t{at[1]} << 16 | std::uint32_t{at[2]} << 8 |
         at[3];
}

void checkPngHeader(const unsigned char* bytes, std::size_t size, const std::string& where) {
  static constexpr unsigned char kBegin[] = {0x89, 'P', 'N', 'G', '\r', '\n', 0x1a, '\n',
                                             0,    0,   0,   13,  'I',  'H',  'D',  'R'};
  if (size < kPngHeader || std::memcmp(bytes, kBegin, sizeof kBegin) != 0)
    refusePicture("is not a PNG", where);
  const std::uint32_t width = bigEndian(bytes + 16), height = bigEndian(bytes + 20);
  if (width < 1 || height < 1 || width > kMostPixels || height > kMostPixels)
    refusePicture("claims " + std::to_string(width) + " x " + std::to_string(height) +
                      " pixels; at most 4096 x 4096 are read",
                  where);
  if (bytes[24] != 8) refusePicture("has not 8 bits a channel", where);
  if (size > std::size_t{4} * width * height + kPngOverhead)
    refusePicture("has more bytes than its pixels need", where);
}

}  // namespace

std::vector<unsigned char> pngOf(const RgbPicture& texture, const std::string& where) {
  if (texture.width < 1 || texture.height < 1 ||
      texture.rgb.size() != std::size_t{3} * texture.width * texture.height)
    refusePicture("does not have as many bytes as its pixels need", where);
  tinygltf::Image image;
  image.width = texture.width;
  image.height = texture.height;
  image.component = 3;
  image.bits = 8;
  image.pixel_type = TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE;
  image.image = texture.rgb;
  std::vector<unsigned char> png = tinygltf_png::encode(image);
  if (png.empty()) refusePicture("cannot be written as PNG", where);
  return png;
}

RgbPicture textureOfPng(const unsigned char* bytes, std::size_t size, const std::string& where) {
  checkPngHeader(bytes, size, where);
  tinygltf::Image image;
  if (!tinygltf::LoadImageData(&image, 0, nullptr, nullptr, 0, 0, bytes, static_cast<int>(size),
                               nullptr))
    refusePicture("is a damaged PNG", where);
  const std::size_t pixels = std::size_t(image.width) * image.height;
  if (image.component != 4 || image.bits != 8 || image.image.size() != 4 * pixels)
    refusePicture("was decoded to something else", where);
  RgbPicture texture{image.width, image.height, std::vector<std::uint8_t>(3 * pixels)};
  for (std::size_t i = 0; i < pixels; ++i) std::memcpy(&texture.rgb[3 * i], &image.image[4 * i], 3);
  return texture;
}

}  // namespace palpa::anatomy
