#include <optional>

#include "anatomy/base/bytes.h"
#include "anatomy/import/mesh_file.h"

namespace palpa::anatomy {
namespace {

enum class Type { int8, uint8, int16, uint16, int32, uint32, float32, float64 };
enum class Coding { text, little, big };

struct Property {
  std::string name;
  Type type = Type::float32;
  std::optional<Type> count;  ///< of a list
};
struct PlyElement {
  std::string name;
  std::size_t count = 0;
  std::vector<Property> properties;
};
struct PlyHeader {
  Coding coding = Coding::text;
  std::vector<PlyElement> elements;
};

constexpr std::size_t kLargestPolygon = 1000;

Type typeOf(const ByteReader& in, std::string_view name) {
  struct Name {
    const char *old_name, *new_name;
    Type type;
  };
  static constexpr Name kNames[] = {
      {"char", "int8", Type::int8},        {"uchar", "uint8", Type::uint8},
      {"short", "int16", Type::int16},     {"ushort", "uint16", Type::uint16},
      {"int", "int32", Type::int32},       {"uint", "uint32", Type::uint32},
      {"float", "float32", Type::float32}, {"double", "float64", Type::float64}};
  for (const Name& n : kNames)
    if (name == n.old_name || name == n.new_name) return n.type;
  in.fail("the header names a type that PLY does not have");
}

Property propertyOf(const ByteReader& in, std::string_view line) {
  Property property;
  std::string_view word = ByteReader::word(line);
  if (word == "list") {
    property.count = typeOf(in, ByteReader::word(line));
    word = ByteReader::word(line);
  }
  property.type = typeOf(in, word);
  property.name = std::string(ByteReader::word(line));
  return property;
}

Coding codingOf(const ByteReader& in, std::string_view name) {
  if (name == "ascii") return Coding::text;
  if (name == "binary_little_endian") return Coding::little;
  if (name == "binary_big_endian") return Coding::big;
  in.fail("its format is not one of PLY's");
}

PlyHeader readHeader(ByteReader& in) {
  if (in.line() != "ply") in.fail("it does not begin with \"ply\"");
  PlyHeader header;
  while (true) {
    if (in.done()) in.fail("its header has no end");
    std::string_view line = in.line();
    const std::string_view kind = ByteReader::word(line);
    if (kind == "end_header") return header;
    if (kind == "format") header.coding = codingOf(in, ByteReader::word(line));
    if (kind == "element") {
      PlyElement element;
      element.name = std::string(ByteReader::word(line));
      const long long count = in.whole(ByteReader::word(line));
      if (count < 0) in.fail("it claims a negative number of elements");
      element.count = static_cast<std::size_t>(count);
      header.elements.push_back(std::move(element));
    }
    if (kind == "property") {
      if (header.elements.empty()) in.fail("a property belongs to nothing");
      header.elements.back().properties.push_back(propertyOf(in, line));
    }
  }
}

double value(ByteReader& in, Coding coding, Type type) {
  if (coding == Coding::text) return in.number(in.word());
  const bool swapped =
      coding == (std::endian::native == std::endian::little ? Coding::big : Coding::little);
  switch (type) {
    case Type::int8:
      return in.take<std::int8_t>();
    case Type::uint8:
      return in.take<std::uint8_t>();
    case Type::int16:
      return in.take<std::int16_t>(swapped);
    case Type::uint16:
      return in.take<std::uint16_t>(swapped);
    case Type::int32:
      return in.take<std::int32_t>(swapped);
    case Type::uint32:
      return in.take<std::uint32_t>(swapped);
    case Type::float32:
      return static_cast<double>(in.take<float>(swapped));
    case Type::float64:
      break;
  }
  return in.take<double>(swapped);
}

std::size_t countOf(ByteReader& in, Coding coding, Type type, std::size_t most) {
  const double count = value(in, coding, type);
  if (!(count >= 0 && count <= static_cast<double>(most)))
    in.fail("it claims a list of " + std::to_string(count) + " entries");
  return static_cast<std::size_t>(count);
}

class PlyBody {
 public:
  PlyBody(ByteReader& in, Coding coding) : in_(in), coding_(coding) {}

  void read(const PlyElement& element, RawMesh* mesh) {
    // Every element takes a byte at least: more of them than bytes are a lie.
    if (element.count > in_.left() || element.properties.empty())
      in_.fail("it claims " + std::to_string(element.count) + " of \"" + element.name + "\"");
    for (std::size_t i = 0; i < element.count; ++i) {
      if (element.name == "vertex")
        readPoint(element, mesh);
      else
        readFace(element, mesh);
    }
  }

 private:
  void readPoint(const PlyElement& element, RawMesh* mesh) {
    Vec3 p = Vec3::Zero();
    for (const Property& property : element.properties) {
      if (property.count) in_.fail("a point has a list");
      const double v = value(in_, coding_, property.type);
      if (property.name.size() == 1 && property.name[0] >= 'x' && property.name[0] <= 'z')
        p[property.name[0] - 'x'] = v;
    }
    if (!p.allFinite()) in_.fail("a point is not a number");
    mesh->points.push_back(p);
  }

  /// Faces, and whatever else there may be: read over.
  void readFace(const PlyElement& element, RawMesh* mesh) {
    std::vector<std::uint32_t> corners;
    for (const Property& property : element.properties) {
      const std::size_t count =
          property.count ? countOf(in_, coding_, *property.count, kLargestPolygon) : 1;
      const bool face = element.name == "face" && property.count &&
                        (property.name == "vertex_indices" || property.name == "vertex_index");
      for (std::size_t k = 0; k < count; ++k) {
        const double v = value(in_, coding_, property.type);
        if (!face) continue;
        if (!(v >= 0 && v < static_cast<double>(mesh->points.size())))
          in_.fail("a face names a point that is not there");
        corners.push_back(static_cast<std::uint32_t>(v));
      }
    }
    addFan(corners, mesh);
  }

  ByteReader& in_;
  Coding coding_;
};

}  // namespace

std::vector<RawMesh> readPly(const std::string& bytes, const std::string& where) {
  ByteReader in(bytes, where, kMeshRemedy);
  const PlyHeader header = readHeader(in);
  RawMesh mesh;
  PlyBody body(in, header.coding);
  for (const PlyElement& element : header.elements) body.read(element, &mesh);
  return {std::move(mesh)};
}

}  // namespace palpa::anatomy
