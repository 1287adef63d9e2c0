#pragma once

#include <tiny_gltf.h>

#include <string>
#include <utility>
#include <vector>

/// What differs between versions of tinygltf: since 2.8 its writer of pictures takes callbacks for
/// files and for addresses as arguments of their own. The header does not say which version it is;
/// the writer's type does.
namespace palpa::anatomy::tinygltf_png {

struct Written {
  const std::string folder, file = "skin.png";
  std::string uri;
  std::vector<unsigned char> bytes;
};

// Only what is to be written leaves through this door; nothing is read.
inline bool keepBytes(std::string*, const std::string&, const std::vector<unsigned char>& bytes,
                      void* kept) {
  *static_cast<std::vector<unsigned char>*>(kept) = bytes;
  return true;
}

using WriterUpTo27 = bool (*)(const std::string*, const std::string*, const tinygltf::Image*, bool,
                              std::string*, void*);
template <class UriCallbacks>
using WriterSince28 = bool (*)(const std::string*, const std::string*, const tinygltf::Image*, bool,
                               const tinygltf::FsCallbacks*, const UriCallbacks*, std::string*,
                               void*);

inline bool write(WriterUpTo27 writer, const tinygltf::Image& image, tinygltf::FsCallbacks door,
                  Written* to) {
  return writer(&to->folder, &to->file, &image, false, &to->uri, &door);
}

template <class UriCallbacks>
bool write(WriterSince28<UriCallbacks> writer, const tinygltf::Image& image,
           tinygltf::FsCallbacks door, Written* to) {
  const UriCallbacks as_it_is{};
  return writer(&to->folder, &to->file, &image, false, &door, &as_it_is, &to->uri, nullptr);
}

/// The bytes of a PNG; empty where it cannot be written.
inline std::vector<unsigned char> encode(const tinygltf::Image& image) {
  Written written;
  tinygltf::FsCallbacks door{};
  door.WriteWholeFile = keepBytes;
  door.user_data = &written.bytes;
  if (!write(&tinygltf::WriteImageData, image, door, &written)) written.bytes.clear();
  return std::move(written.bytes);
}

}  // namespace palpa::anatomy::tinygltf_png
