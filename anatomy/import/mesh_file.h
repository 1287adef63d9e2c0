#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "anatomy/base/error.h"
#include "anatomy/geometry/pose.h"

namespace palpa::anatomy {

/// A surface as a file has it: the file's own unit and axes, nothing promised but that indices are
/// in range and numbers finite.
struct RawMesh {
  std::string name;  ///< of the object or node in the file; else the file's name
  std::vector<Vec3> points;
  std::vector<std::array<std::uint32_t, 3>> triangles;
};

/// What the file says it is: by its ending, .glb .obj .stl .ply.
enum class MeshFormat { gltf, obj, stl, ply };
MeshFormat meshFormat(const std::filesystem::path& file);  ///< throws UsageError for another ending

/// All surfaces of a file that nobody vouches for. Polygons become fans of triangles; glTF nodes
/// are placed by their transforms. What a file claims is checked against its size before memory is
/// taken. Throws Error.
std::vector<RawMesh> readMeshFile(const std::filesystem::path& file);

/// The same from bytes; `where` begins every message.
std::vector<RawMesh> readMesh(MeshFormat format, const std::string& bytes,
                              const std::string& where);

}  // namespace palpa::anatomy

/// One reader a format; each throws Error. Not for others than mesh_file.cpp.
namespace palpa::anatomy {

std::vector<RawMesh> readObj(const std::string& bytes, const std::string& where);
std::vector<RawMesh> readStl(const std::string& bytes, const std::string& where);
std::vector<RawMesh> readPly(const std::string& bytes, const std::string& where);
std::vector<RawMesh> readGltf(const std::string& bytes, const std::string& where);

inline constexpr const char* kMeshRemedy = "Export the surface again or take another file";

[[noreturn]] inline void refuseMesh(const std::string& what, const std::string& where) {
  throw Error(what, where, kMeshRemedy);
}

/// A polygon as triangles about its first corner.
inline void addFan(const std::vector<std::uint32_t>& corners, RawMesh* mesh) {
  for (std::size_t i = 2; i < corners.size(); ++i)
    mesh->triangles.push_back({corners[0], corners[i - 1], corners[i]});
}

}  // namespace palpa::anatomy
