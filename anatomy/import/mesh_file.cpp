#include "anatomy/import/mesh_file.h"

#include <algorithm>
#include <cctype>
#include <fstream>
#include <iterator>

#include "anatomy/import/readers.h"

namespace palpa::anatomy {
namespace {

constexpr std::uintmax_t kLargestFile = 1u << 30;  // 1 GiB

std::string load(const std::filesystem::path& file) {
  std::error_code failure;
  const std::uintmax_t size = std::filesystem::file_size(file, failure);
  if (failure) refuseMesh("cannot be opened (" + failure.message() + ")", file.string());
  if (size > kLargestFile) refuseMesh("is larger than 1 GiB", file.string());
  std::ifstream stream(file, std::ios::binary);
  std::string bytes(static_cast<std::size_t>(size), '\0');
  stream.read(bytes.data(), static_cast<std::streamsize>(size));
  if (!stream) refuseMesh("cannot be read", file.string());
  return bytes;
}

}  // namespace

MeshFormat meshFormat(const std::filesystem::path& file) {
  std::string ending = file.extension().string();
  std::transform(ending.begin(), ending.end(), ending.begin(),
                 [](unsigned char c) { return std::tolower(c); });
  if (ending == ".glb") return MeshFormat::gltf;
  if (ending == ".obj") return MeshFormat::obj;
  if (ending == ".stl") return MeshFormat::stl;
  if (ending == ".ply") return MeshFormat::ply;
  throw UsageError("ends in \"" + ending + "\"", file.string(),
                   "Surfaces are read from .glb, .obj, .stl and .ply");
}

std::vector<RawMesh> readMesh(MeshFormat format, const std::string& bytes,
                              const std::string& where) {
  std::vector<RawMesh> meshes = format == MeshFormat::gltf  ? readGltf(bytes, where)
                                : format == MeshFormat::obj ? readObj(bytes, where)
                                : format == MeshFormat::stl ? readStl(bytes, where)
                                                            : readPly(bytes, where);
  std::erase_if(meshes, [](const RawMesh& mesh) { return mesh.triangles.empty(); });
  if (meshes.empty()) refuseMesh("holds no surface", where);
  return meshes;
}

std::vector<RawMesh> readMeshFile(const std::filesystem::path& file) {
  std::vector<RawMesh> meshes = readMesh(meshFormat(file), load(file), file.string());
  for (RawMesh& mesh : meshes)
    if (mesh.name.empty()) mesh.name = file.stem().string();
  return meshes;
}

}  // namespace palpa::anatomy
