#include "picture.h"

#include <cstdlib>
#include <fstream>
#include <iterator>
#include <stdexcept>
#include <string>

namespace palpa::guide {
namespace {

int number(const std::string& bytes, std::size_t at, int count) {
  int value = 0;
  for (int i = 0; i < count; ++i)
    value = value << 8 | static_cast<unsigned char>(bytes.at(at + static_cast<std::size_t>(i)));
  return value;
}

/// JPEG: segments until the one that begins a frame (C0 to CF but C4, C8, CC).
PictureSize sizeOfJpeg(const std::string& bytes) {
  for (std::size_t at = 2; at + 9 < bytes.size();) {
    const int kind = number(bytes, at, 2);
    if (kind >= 0xffc0 && kind <= 0xffcf && kind != 0xffc4 && kind != 0xffc8 && kind != 0xffcc)
      return {number(bytes, at + 7, 2), number(bytes, at + 5, 2)};
    at += 2 + static_cast<std::size_t>(number(bytes, at + 2, 2));
  }
  throw std::runtime_error("a JPEG without a frame");
}

/// The number in `name="..."` of the first tag; 0: it has none.
int attribute(const std::string& svg, const std::string& name) {
  const std::string head = svg.substr(0, svg.find('>'));
  const std::size_t at = head.find(" " + name + "=\"");
  return at == std::string::npos ? 0 : std::atoi(head.c_str() + at + name.size() + 3);
}

}  // namespace

std::string bytesOf(const std::filesystem::path& file) {
  std::ifstream stream(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(stream), std::istreambuf_iterator<char>()};
}

PictureSize sizeOf(const std::filesystem::path& picture) {
  const std::string bytes = bytesOf(picture);
  if (bytes.starts_with("\x89PNG\r\n") && bytes.size() > 24)
    return {number(bytes, 16, 4), number(bytes, 20, 4)};
  if (bytes.starts_with("\xff\xd8")) return sizeOfJpeg(bytes);
  if (bytes.starts_with("<svg ")) return {attribute(bytes, "width"), attribute(bytes, "height")};
  throw std::runtime_error(picture.string() + " is neither PNG nor JPEG nor SVG");
}

}  // namespace palpa::guide
