#include "anatomy/import/readers.h"

namespace palpa::anatomy {
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
  ByteReader in(bytes, where);
  return {isText(bytes) ? readText(in) : readBinary(in)};
}

}  // namespace palpa::anatomy
