#include <algorithm>
#include <cctype>
#include <map>

#include "anatomy/base/bytes.h"
#include "anatomy/volume/raw_voxels.h"
#include "anatomy/volume/volume.h"

namespace palpa::anatomy {
namespace {

constexpr std::size_t kLongestHeader = 64 * 1024;

struct MetaHeader {
  std::map<std::string, std::string> fields;
  std::string data_file;
  std::size_t bytes = 0;  ///< of the header, to the first voxel of a LOCAL file
};

std::string trimmed(std::string_view text) {
  const std::size_t begin = text.find_first_not_of(" \t\r"), end = text.find_last_not_of(" \t\r");
  return begin == std::string_view::npos ? std::string()
                                         : std::string(text.substr(begin, end - begin + 1));
}

class MetaImage {
 public:
  MetaImage(std::string_view bytes, const std::string& where)
      : bytes_(bytes), where_(where), words_({}, where, kVolumeRemedy) {
    parse();
  }

  Volume read(const BytesBeside& beside) const {
    checkKind();
    Volume volume;
    std::size_t count = 1;
    const std::vector<double> size = numbers("DimSize", 3), steps = spacing();
    for (std::size_t a = 0; a < 3; ++a) {
      if (!(size[a] >= 0 && size[a] <= 1e6)) words_.fail("DimSize is absurd");
      volume.size[a] = static_cast<int>(size[a]);
      count *= static_cast<std::size_t>(std::max(volume.size[a], 1));
    }
    const Mat3 directions = axes();
    for (int a = 0; a < 3; ++a)
      volume.steps_S.col(a) = 1e-3 * steps[static_cast<std::size_t>(a)] * directions.col(a);
    const std::vector<double> offset = origin();
    volume.origin_S = 1e-3 * Vec3(offset[0], offset[1], offset[2]);
    checkGeometry(volume, where_);
    volume.values = voxels(count, beside);
    return volume;
  }

 private:
  void parse() {
    std::size_t at = 0;
    while (true) {
      const std::size_t end = bytes_.find('\n', at);
      if (end == std::string_view::npos || end > kLongestHeader)
        words_.fail("its header does not end with ElementDataFile");
      const std::string_view line = bytes_.substr(at, end - at);
      at = end + 1;
      const std::size_t equals = line.find('=');
      if (equals == std::string_view::npos) {
        if (trimmed(line).empty()) continue;
        words_.fail("a line of its header has no \"=\"");
      }
      const std::string key = trimmed(line.substr(0, equals));
      header_.fields[key] = trimmed(line.substr(equals + 1));
      if (key != "ElementDataFile") continue;
      header_.data_file = header_.fields[key];
      header_.bytes = at;
      return;
    }
  }

  const std::string* field(std::initializer_list<const char*> names) const {
    for (const char* name : names)
      if (const auto found = header_.fields.find(name); found != header_.fields.end())
        return &found->second;
    return nullptr;
  }

  bool flag(std::initializer_list<const char*> names, bool otherwise) const {
    const std::string* text = field(names);
    return text ? !text->empty() &&
                      (std::toupper(static_cast<unsigned char>(text->front())) == 'T' ||
                       text->front() == '1')
                : otherwise;
  }

  std::vector<double> numbersIn(const std::string& text, std::size_t count, const char* key) const {
    std::vector<double> found;
    std::string_view rest = text;
    for (std::string_view word = ByteReader::word(rest); !word.empty();
         word = ByteReader::word(rest))
      found.push_back(words_.number(word));
    if (found.size() != count)
      words_.fail(std::string(key) + " has not " + std::to_string(count) + " numbers");
    return found;
  }

  std::vector<double> numbers(const char* key, std::size_t count) const {
    const std::string* text = field({key});
    if (!text) words_.fail(std::string(key) + " is missing");
    return numbersIn(*text, count, key);
  }

  void checkKind() const {
    const std::string* kind = field({"ObjectType"});
    if (!kind || *kind != "Image") words_.fail("it is not a MetaImage (ObjectType = Image)");
    if (numbers("NDims", 1)[0] != 3) words_.fail("it has not three dimensions");
    if (!flag({"BinaryData"}, true)) words_.fail("its voxels are text, which is not read");
    const std::string* channels = field({"ElementNumberOfChannels"});
    if (channels && *channels != "1") words_.fail("it has several values a voxel");
  }

  std::vector<double> spacing() const {
    const char* key = field({"ElementSpacing"}) ? "ElementSpacing" : "ElementSize";
    if (!field({key})) words_.fail("ElementSpacing is missing: nobody knows how large it is");
    return numbers(key, 3);
  }

  std::vector<double> origin() const {
    for (const char* key : {"Offset", "Position", "Origin"})
      if (field({key})) return numbers(key, 3);
    return {0, 0, 0};
  }

  Mat3 axes() const {
    for (const char* key : {"TransformMatrix", "Rotation", "Orientation"}) {
      if (!field({key})) continue;
      const std::vector<double> m = numbers(key, 9);  // the i axis first
      Mat3 directions;
      for (int n = 0; n < 9; ++n) directions(n % 3, n / 3) = m[static_cast<std::size_t>(n)];
      for (int a = 0; a < 3; ++a)
        if (!(std::abs(directions.col(a).norm() - 1) < 0.01))
          words_.fail(std::string(key) + " is no turn");
      return directions;
    }
    const std::string* from = field({"AnatomicalOrientation"});
    return from && *from != "???" ? axesFrom(*from) : Mat3(Mat3::Identity());
  }

  // Letters say where the axes come from: "RAI" goes to the left, to the back, up.
  Mat3 axesFrom(const std::string& letters) const {
    static constexpr std::string_view kFrom = "RLAPIS";
    Mat3 directions = Mat3::Zero();
    for (std::size_t a = 0; a < 3 && letters.size() == 3; ++a) {
      const std::size_t found = kFrom.find(letters[a]);
      if (found != std::string_view::npos)
        directions(static_cast<int>(found / 2), static_cast<int>(a)) = found % 2 ? -1 : 1;
    }
    if (directions.determinant() == 0)
      words_.fail("AnatomicalOrientation is \"" + letters.substr(0, 8) + "\"");
    return directions;
  }

  VoxelType type() const {
    static const std::map<std::string, VoxelType> kTypes{
        {"MET_CHAR", VoxelType::int8},     {"MET_UCHAR", VoxelType::uint8},
        {"MET_SHORT", VoxelType::int16},   {"MET_USHORT", VoxelType::uint16},
        {"MET_INT", VoxelType::int32},     {"MET_UINT", VoxelType::uint32},
        {"MET_FLOAT", VoxelType::float32}, {"MET_DOUBLE", VoxelType::float64}};
    const std::string* text = field({"ElementType"});
    const auto found = kTypes.find(text ? *text : "");
    if (found == kTypes.end())
      words_.fail("ElementType is " +
                  (text ? "\"" + text->substr(0, 24) + "\"" : std::string("missing")));
    return found->second;
  }

  std::vector<float> voxels(std::size_t count, const BytesBeside& beside) const {
    const bool local = header_.data_file == "LOCAL" || header_.data_file == "Local" ||
                       header_.data_file == "local";
    if (!local && (header_.data_file.empty() ||
                   header_.data_file.find_first_of("/\\% ") != std::string::npos ||
                   header_.data_file == "LIST" || header_.data_file == ".."))
      words_.fail("ElementDataFile is not LOCAL and not one file in the same folder");
    const std::string other = local ? std::string() : beside(header_.data_file);
    std::string_view data = local ? bytes_.substr(header_.bytes) : std::string_view(other);
    const VoxelType kind = type();
    const std::size_t size = count * bytesOf(kind);
    const bool swapped = flag({"BinaryDataByteOrderMSB", "ElementByteOrderMSB"}, false);
    if (flag({"CompressedData"}, false)) {
      const std::string raw = inflated(data, size, true, where_);
      return voxelsOf(raw, kind, count, swapped, 1, 0, where_);
    }
    return voxelsOf(data.substr(skipped(data.size(), size)), kind, count, swapped, 1, 0, where_);
  }

  // HeaderSize in a file of voxels; -1: they are its end.
  std::size_t skipped(std::size_t there, std::size_t size) const {
    if (!field({"HeaderSize"})) return 0;
    const double bytes = numbers("HeaderSize", 1)[0];
    if (bytes == -1 && there >= size) return there - size;
    if (!(bytes >= 0 && bytes <= static_cast<double>(there)))
      words_.fail("HeaderSize is beyond its end");
    return static_cast<std::size_t>(bytes);
  }

  std::string_view bytes_;
  std::string where_;
  ByteReader words_;
  MetaHeader header_;
};

}  // namespace

Volume readMetaImage(std::string_view bytes, const std::string& where, const BytesBeside& beside) {
  return MetaImage(bytes, where).read(beside);
}

}  // namespace palpa::anatomy
