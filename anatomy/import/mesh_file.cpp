#include "anatomy/import/mesh_file.h"

#include <algorithm>
#include <cctype>
#include <fstream>
#include <iterator>

#include "anatomy/base/bytes.h"
#include "anatomy/base/whole_file.h"

namespace palpa::anatomy {
namespace {

constexpr std::uintmax_t kLargestFile = 1u << 30;  // 1 GiB

std::string load(const std::filesystem::path& file) {
  std::error_code failure;
  const std::uintmax_t size = std::filesystem::file_size(file, failure);
  if (failure) refuseMesh("cannot be opened (" + whyUnread(failure) + ")", file.string());
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

namespace {

/// "7/2/3" -> 7; negative counts from the newest point.
std::uint32_t cornerOf(const ByteReader& in, std::string_view word, std::size_t points) {
  const long long index = in.whole(word.substr(0, word.find('/')));
  const long long count = static_cast<long long>(points);
  const long long at = index > 0 ? index - 1 : count + index;
  if (index == 0 || at < 0 || at >= count)
    in.fail("a face names point " + std::to_string(index) + ", which is not there");
  return static_cast<std::uint32_t>(at);
}

}  // namespace

std::vector<RawMesh> readObj(const std::string& bytes, const std::string& where) {
  ByteReader in(bytes, where, kMeshRemedy);
  RawMesh mesh;
  while (!in.done()) {
    std::string_view line = in.line();
    const std::string_view kind = ByteReader::word(line);
    if (kind == "v") {
      Vec3 p;
      for (int i = 0; i < 3; ++i) p[i] = in.number(ByteReader::word(line));
      mesh.points.push_back(p);
    } else if (kind == "o" && mesh.name.empty()) {
      mesh.name = std::string(ByteReader::word(line));
    } else if (kind == "f") {
      std::vector<std::uint32_t> corners;
      for (std::string_view word = ByteReader::word(line); !word.empty();
           word = ByteReader::word(line))
        corners.push_back(cornerOf(in, word, mesh.points.size()));
      addFan(corners, &mesh);
    }
  }
  return {std::move(mesh)};
}

namespace {

constexpr std::size_t kHeader = 80, kFacet = 50;

void addCorner(const Vec3& p, RawMesh* mesh) {
  if (mesh->points.size() % 3 == 2) {
    const auto last = static_cast<std::uint32_t>(mesh->points.size());
    mesh->triangles.push_back({last - 2, last - 1, last});
  }
  mesh->points.push_back(p);
}

RawMesh readBinary(ByteReader& in) {
  in.skip(kHeader);
  const std::uint32_t count = in.take<std::uint32_t>();
  if (in.left() / kFacet < count)
    in.fail("it claims " + std::to_string(count) + " facets and has room for " +
            std::to_string(in.left() / kFacet));
  RawMesh mesh;
  mesh.points.reserve(3 * static_cast<std::size_t>(count));
  for (std::uint32_t i = 0; i < count; ++i) {
    in.skip(3 * sizeof(float));  // a normal that follows from the corners
    for (int corner = 0; corner < 3; ++corner) {
      Vec3 p;
      for (int k = 0; k < 3; ++k) p[k] = static_cast<double>(in.take<float>());
      if (!p.allFinite())
        in.fail("facet " + std::to_string(i) + " has a corner that is not a number");
      addCorner(p, &mesh);
    }
    in.skip(2);
  }
  return mesh;
}

RawMesh readText(ByteReader& in) {
  RawMesh mesh;
  while (!in.done()) {
    std::string_view line = in.line();
    if (ByteReader::word(line) != "vertex") continue;
    Vec3 p;
    for (int k = 0; k < 3; ++k) p[k] = in.number(ByteReader::word(line));
    addCorner(p, &mesh);
  }
  if (mesh.points.size() % 3 != 0) in.fail("its last facet has fewer than three corners");
  return mesh;
}

/// "solid" begins text files, and some binary ones: those have the length that their count asks
/// for, or no facet in words.
bool isText(const std::string& bytes) {
  if (bytes.compare(0, 5, "solid") != 0) return false;
  if (bytes.size() < kHeader + 4) return true;
  std::uint32_t count = 0;
  std::memcpy(&count, bytes.data() + kHeader, sizeof count);
  if (bytes.size() == kHeader + 4 + kFacet * static_cast<std::size_t>(count)) return false;
  return std::string_view(bytes).substr(0, 1024).find("facet") != std::string_view::npos;
}

}  // namespace

std::vector<RawMesh> readStl(const std::string& bytes, const std::string& where) {
  ByteReader in(bytes, where, kMeshRemedy);
  return {isText(bytes) ? readText(in) : readBinary(in)};
}

}  // namespace palpa::anatomy
