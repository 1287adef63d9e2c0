#pragma once

#include <cstring>
#include <sstream>
#include <string>

#include "anatomy/import/mesh_file.h"

/// One small solid in every format, written byte by byte here: nothing of the readers is in it.
namespace palpa::anatomy::test {

/// A box of 2 x 3 x 4 about (1, 1, 1), corners once, seen from outside counter-clockwise.
inline RawMesh box() {
  RawMesh mesh;
  for (int i = 0; i < 8; ++i)
    mesh.points.push_back({i & 1 ? 2.0 : 0.0, i & 2 ? 2.5 : -0.5, i & 4 ? 3.0 : -1.0});
  for (const auto& [a, b, c, d] :
       {std::array{0u, 2u, 3u, 1u}, std::array{4u, 5u, 7u, 6u}, std::array{0u, 1u, 5u, 4u},
        std::array{2u, 6u, 7u, 3u}, std::array{0u, 4u, 6u, 2u}, std::array{1u, 3u, 7u, 5u}}) {
    mesh.triangles.push_back({a, b, c});
    mesh.triangles.push_back({a, c, d});
  }
  return mesh;
}

inline std::string words(const Vec3& p) {
  std::ostringstream text;
  text << p.x() << ' ' << p.y() << ' ' << p.z();
  return text.str();
}

inline std::string asObj(const RawMesh& mesh) {
  std::string text = "# a comment\no box\n";
  for (const Vec3& p : mesh.points) text += "v " + words(p) + "\n";
  text += "vn 0 0 1\nvt 0 0\ng skin\n";
  bool relative = false;
  for (const auto& t : mesh.triangles) {
    text += "f";
    for (const std::uint32_t c : t) {
      const long long index =
          relative ? static_cast<long long>(c) - static_cast<long long>(mesh.points.size()) : c + 1;
      text += " " + std::to_string(index) + (relative ? "//1" : "/1/1");
    }
    text += "\r\n";
    relative = !relative;
  }
  return text;
}

template <class T>
void put(std::string& bytes, T value, bool swapped = false) {
  char raw[sizeof(T)];
  std::memcpy(raw, &value, sizeof(T));
  if (swapped) std::reverse(raw, raw + sizeof(T));
  bytes.append(raw, sizeof(T));
}

inline std::string asStl(const RawMesh& mesh, bool text) {
  std::string bytes = text ? "solid box\n" : "solid, and binary all the same";
  if (!text) {
    bytes.resize(80, ' ');
    put(bytes, static_cast<std::uint32_t>(mesh.triangles.size()));
  }
  for (const auto& t : mesh.triangles) {
    if (text)
      bytes += "facet normal 0 0 0\n outer loop\n";
    else
      for (int k = 0; k < 3; ++k) put(bytes, 0.0f);
    for (const std::uint32_t c : t) {
      if (text)
        bytes += "  vertex " + words(mesh.points[c]) + "\n";
      else
        for (int k = 0; k < 3; ++k) put(bytes, static_cast<float>(mesh.points[c][k]));
    }
    if (text)
      bytes += " endloop\nendfacet\n";
    else
      put(bytes, std::uint16_t{0});
  }
  return text ? bytes + "endsolid box\n" : bytes;
}

/// `coding`: 't'ext, 'l'ittle, 'b'ig. A colour and a list that nobody asked for stand in it, too.
inline std::string asPly(const RawMesh& mesh, char coding) {
  std::string bytes =
      "ply\nformat " +
      std::string(coding == 't'   ? "ascii"
                  : coding == 'l' ? "binary_little_endian"
                                  : "binary_big_endian") +
      " 1.0\ncomment made here\nelement vertex " + std::to_string(mesh.points.size()) +
      "\nproperty double x\nproperty double y\nproperty double z\nproperty uchar red\nelement "
      "face " +
      std::to_string(mesh.triangles.size()) +
      "\nproperty list uchar int vertex_indices\nproperty list uchar float texcoord\nend_header\n";
  const bool swapped = coding == 'b';
  for (const Vec3& p : mesh.points) {
    if (coding == 't')
      bytes += words(p) + " 7\n";
    else {
      for (int k = 0; k < 3; ++k) put(bytes, p[k], swapped);
      put(bytes, std::uint8_t{7});
    }
  }
  for (const auto& t : mesh.triangles) {
    if (coding == 't') {
      bytes += "3 " + std::to_string(t[0]) + ' ' + std::to_string(t[1]) + ' ' +
               std::to_string(t[2]) + " 2 0.5 0.25\n";
      continue;
    }
    put(bytes, std::uint8_t{3});
    for (const std::uint32_t c : t) put(bytes, static_cast<std::int32_t>(c), swapped);
    put(bytes, std::uint8_t{1});
    put(bytes, 0.5f, swapped);
  }
  return bytes;
}

/// The box in a node that is moved, in a parent that is turned a quarter about x and made twice as
/// large. `ring`: its parent is also its child.
inline std::string asGlb(const RawMesh& mesh, bool ring = false) {
  std::string data;
  for (const Vec3& p : mesh.points)
    for (int k = 0; k < 3; ++k) put(data, static_cast<float>(p[k]));
  const std::size_t points = data.size();
  for (const auto& t : mesh.triangles)
    for (const std::uint32_t c : t) put(data, static_cast<std::uint16_t>(c));
  const std::size_t indices = data.size() - points;
  while (data.size() % 4) data += '\0';
  std::string json =
      std::string(
          R"({"asset":{"version":"2.0"},"scene":0,"scenes":[{"nodes":[0]}],"nodes":[)"
          R"({"name":"turned","rotation":[0.70710678118654752,0,0,0.70710678118654752],"scale":[2,2,2],"children":[1]},)"
          R"({"name":"box","translation":[0,0,5],"mesh":0)") +
      (ring ? R"(,"children":[0])" : "") +
      R"(}],"meshes":[{"name":"m","primitives":[{"attributes":{"POSITION":0},"indices":1}]}],)"
      R"("accessors":[{"bufferView":0,"componentType":5126,"count":)" +
      std::to_string(mesh.points.size()) +
      R"(,"type":"VEC3","min":[0,-0.5,-1],"max":[2,2.5,3]},{"bufferView":1,"componentType":5123,"count":)" +
      std::to_string(3 * mesh.triangles.size()) +
      R"(,"type":"SCALAR"}],"bufferViews":[{"buffer":0,"byteOffset":0,"byteLength":)" +
      std::to_string(points) + R"(},{"buffer":0,"byteOffset":)" + std::to_string(points) +
      R"(,"byteLength":)" + std::to_string(indices) + R"(}],"buffers":[{"byteLength":)" +
      std::to_string(data.size()) + "}]}";
  while (json.size() % 4) json += ' ';
  std::string bytes = "glTF";
  put(bytes, std::uint32_t{2});
  put(bytes, static_cast<std::uint32_t>(12 + 8 + json.size() + 8 + data.size()));
  put(bytes, static_cast<std::uint32_t>(json.size()));
  bytes += "JSON" + json;
  put(bytes, static_cast<std::uint32_t>(data.size()));
  bytes += std::string("BIN\0", 4) + data;
  return bytes;
}

}  // namespace palpa::anatomy::test
