#include "anatomy/patient/gltf.h"

#include <cstring>
#include <filesystem>
#include <fstream>

#include "anatomy/base/error.h"

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
  if (failure) fail("the file cannot be opened (" + failure.message() + ")", file);
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

}  // namespace palpa::anatomy
