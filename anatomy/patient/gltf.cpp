#include "anatomy/patient/gltf.h"

#include <cstring>
#include <filesystem>
#include <fstream>

#include "anatomy/base/error.h"
#include "anatomy/base/whole_file.h"
#include "anatomy/patient/tinygltf_png.h"

namespace palpa::anatomy {
namespace {

constexpr std::size_t kHeader = 12, kChunkHeader = 8;
constexpr std::uintmax_t kLargestFile = 1u << 30;  // 1 GiB: no patient comes near it
constexpr int kDeepest = 32;                       // nesting of the JSON part; glTF needs about 8

[[noreturn]] void fail(const std::string& what, const std::string& file) {
  throw Error(what, file, "Write the patient again or take another file");
}

std::string load(const std::string& file) {
  std::error_code failure;
  const std::uintmax_t size = std::filesystem::file_size(file, failure);
  if (failure) fail("the file cannot be opened (" + whyUnread(failure) + ")", file);
  if (size > kLargestFile) fail("the file is larger than 1 GiB", file);
  std::string bytes(size, '\0');
  std::ifstream in(file, std::ios::binary);
  in.read(bytes.data(), static_cast<std::streamsize>(size));
  if (!in) fail("the file cannot be read", file);
  return bytes;
}

std::uint32_t word(std::string_view bytes, std::size_t at) {
  std::uint32_t value;
  std::memcpy(&value, bytes.data() + at, sizeof value);
  return value;
}

// The parser recurses into arrays and objects: a file of brackets would overflow the stack.
bool nestedTooDeep(std::string_view json) {
  int depth = 0;
  bool text = false;
  for (std::size_t i = 0; i < json.size(); ++i) {
    const char c = json[i];
    if (text && c == '\\')
      ++i;
    else if (c == '"')
      text = !text;
    else if (!text && (c == '{' || c == '['))
      ++depth;
    else if (!text && (c == '}' || c == ']'))
      --depth;
    if (depth > kDeepest) return true;
  }
  return false;
}

void checkContainer(std::string_view bytes, const std::string& file) {
  if (bytes.size() < kHeader + kChunkHeader || std::memcmp(bytes.data(), "glTF", 4) != 0)
    fail("this is not a glTF binary file", file);
  if (word(bytes, 4) != 2) fail("this is not glTF version 2", file);
  if (word(bytes, 8) != bytes.size())
    fail("the file has " + std::to_string(bytes.size()) + " bytes instead of the " +
             std::to_string(word(bytes, 8)) + " it claims: it was cut or damaged",
         file);
  const std::size_t json = word(bytes, kHeader);
  if (std::memcmp(bytes.data() + kHeader + 4, "JSON", 4) != 0 ||
      json > bytes.size() - kHeader - kChunkHeader)
    fail("the JSON part is damaged", file);
  if (nestedTooDeep(bytes.substr(kHeader + kChunkHeader, json)))
    fail("the JSON part is nested too deep", file);
}

// A patient is one file: nothing else may be opened on its behalf.
tinygltf::FsCallbacks closedDoors() {
  tinygltf::FsCallbacks closed{};
  closed.FileExists = [](const std::string&, void*) { return false; };
  closed.ExpandFilePath = [](const std::string& path, void*) { return path; };
  using Bytes = std::vector<unsigned char>;
  closed.ReadWholeFile = [](Bytes*, std::string*, const std::string&, void*) { return false; };
  closed.WriteWholeFile = [](std::string*, const std::string&, const Bytes&, void*) {
    return false;
  };
  return closed;
}

}  // namespace

tinygltf::Model readGltfBinary(const std::string& file) {
  return parseGltfBinary(load(file), file);
}

tinygltf::Model parseGltfBinary(std::string_view bytes, const std::string& where) {
  checkContainer(bytes, where);
  tinygltf::TinyGLTF loader;
  loader.SetFsCallbacks(closedDoors());
  loader.SetImageLoader([](tinygltf::Image*, const int, std::string*, std::string*, int, int,
                           const unsigned char*, int, void*) { return true; },
                        nullptr);
  tinygltf::Model model;
  std::string error, warning;
  bool good = false;
  try {
    good = loader.LoadBinaryFromMemory(&model, &error, &warning,
                                       reinterpret_cast<const unsigned char*>(bytes.data()),
                                       static_cast<unsigned int>(bytes.size()), "");
  } catch (const std::exception&) {  // whatever a damaged file provokes
    good = false;
  }
  if (!good) fail("the glTF is damaged: what it says of its parts does not fit them", where);
  return model;
}

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
