#include "anatomy/import/readers.h"

namespace palpa::anatomy {
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
  ByteReader in(bytes, where);
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

}  // namespace palpa::anatomy
