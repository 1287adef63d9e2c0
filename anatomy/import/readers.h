#pragma once

#include "anatomy/import/byte_reader.h"
#include "anatomy/import/mesh_file.h"

/// One reader a format; each throws Error. Not for others than mesh_file.cpp.
namespace palpa::anatomy {

std::vector<RawMesh> readObj(const std::string& bytes, const std::string& where);
std::vector<RawMesh> readStl(const std::string& bytes, const std::string& where);
std::vector<RawMesh> readPly(const std::string& bytes, const std::string& where);
std::vector<RawMesh> readGltf(const std::string& bytes, const std::string& where);

/// A polygon as triangles about its first corner.
inline void addFan(const std::vector<std::uint32_t>& corners, RawMesh* mesh) {
  for (std::size_t i = 2; i < corners.size(); ++i)
    mesh->triangles.push_back({corners[0], corners[i - 1], corners[i]});
}

}  // namespace palpa::anatomy
