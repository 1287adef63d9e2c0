#include <gdcmAttribute.h>
#include <gdcmImageReader.h>
#include <gdcmReader.h>
#include <gdcmTrace.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <map>
#include <optional>
#include <string_view>

#include "anatomy/base/error.h"
#include "anatomy/base/quantile.h"
#include "anatomy/base/whole_file.h"
#include "anatomy/volume/raw_voxels.h"
#include "anatomy/volume/volume.h"

namespace palpa::anatomy {
namespace {

constexpr double kUneven = 0.1;  // of the distance between slices
constexpr std::size_t kMostFiles = 5000;

struct Slice {
  std::filesystem::path file;
  std::string series, words;
  Vec3 origin_mm = Vec3::Zero(), along_row = Vec3::UnitX(), along_column = Vec3::UnitY();
  double row_mm = 0, column_mm = 0,
         place_mm = 0;  ///< steps down a column, along a row; along the normal
  int rows = 0, columns = 0;
};

[[noreturn]] void refuseSeries(const std::string& what, const std::string& where,
                               const std::string& remedy) {
  throw Error(what, where, remedy);
}

template <std::uint16_t group, std::uint16_t element>
auto valueOf(const gdcm::DataSet& data, bool* there) {
  gdcm::Attribute<group, element> value;
  *there = data.FindDataElement(value.GetTag()) && !data.GetDataElement(value.GetTag()).IsEmpty();
  if (*there) value.SetFromDataSet(data);
  return value;
}

std::string trimmedText(std::string text) {
  while (!text.empty() && (text.back() == ' ' || text.back() == '\0')) text.pop_back();
  return text;
}

/// What a gray picture says of its voxels: one sample, whole bytes, sign 0 or 1.
bool sensible(std::uint32_t tag, std::string_view value) {
  std::uint16_t number = 0;
  if (value.size() < 2) return false;
  std::memcpy(&number, value.data(), 2);
  switch (tag) {
    case 0x00280002:
      return number == 1;
    case 0x00280010:
    case 0x00280011:
      return number > 0 && number <= 4096;
    case 0x00280100:
      return number == 8 || number == 16 || number == 32;
    case 0x00280101:
      return number >= 1 && number <= 32;
    case 0x00280102:
      return number < 32;
    case 0x00280103:
      return number <= 1;
    default:
      return true;
  }
}

constexpr std::string_view kShortKinds = "AEASATCSDADSDTFLFDISLOLTPNSHSLSSSTTMUIULUS",
                           kLongKinds = "OBODOFOLOWSQUCUNURUT";
constexpr std::uint32_t kUndefined = 0xffffffff, kItem = 0xfffee000, kEndOfSequence = 0xfffee0dd;

bool among(std::string_view kinds, std::string_view kind) {
  for (std::size_t i = 0; i + 1 < kinds.size(); i += 2)
    if (kinds.substr(i, 2) == kind) return true;
  return false;
}

template <class Number>
Number numberAt(std::string_view bytes, std::size_t at) {
  Number number;
  std::memcpy(&number, &bytes[at], sizeof number);
  return number;
}

std::uint32_t tagAt(std::string_view bytes, std::size_t at) {
  return static_cast<std::uint32_t>(numberAt<std::uint16_t>(bytes, at)) << 16 |
         numberAt<std::uint16_t>(bytes, at + 2);
}

/// A length that a part of the file states, and where its content begins.
struct StatedLength {
  std::uint32_t length = 0;
  std::size_t content = 0;
};

/// None: the file ends, or the kind is not known (with kinds).
std::optional<StatedLength> lengthAt(std::string_view bytes, std::size_t at, bool with_kinds) {
  if (bytes.size() - at < 8) return std::nullopt;
  const bool mark = (tagAt(bytes, at) >> 16) == 0xfffe;  // of an item or an end: has no kind
  const std::string_view kind = bytes.substr(at + 4, 2);
  if (mark || !with_kinds) return StatedLength{numberAt<std::uint32_t>(bytes, at + 4), at + 8};
  if (among(kShortKinds, kind)) return StatedLength{numberAt<std::uint16_t>(bytes, at + 6), at + 8};
  if (!among(kLongKinds, kind) || bytes.size() - at < 12) return std::nullopt;
  return StatedLength{numberAt<std::uint32_t>(bytes, at + 8), at + 12};
}

/// Whether each part that is nested in others, or stands without its kind, ends inside the file.
/// GDCM takes as much memory as a length says before it looks whether so much is there. What cannot
/// be followed is left to GDCM.
bool lengthsFit(std::string_view bytes, std::size_t at, bool with_kinds) {
  bool pieces = false;  // of a compressed picture: what is in an item are no further parts
  int unknown = 0;      // sequences, one in another, of which the outermost has no kind inside
  while (at < bytes.size()) {
    const std::optional<StatedLength> stated = lengthAt(bytes, at, with_kinds && unknown == 0);
    if (!stated) return true;
    const std::uint32_t tag = tagAt(bytes, at);
    const std::string_view kind = with_kinds && unknown == 0 ? bytes.substr(at + 4, 2) : "";
    const bool open = stated->length == kUndefined, item = (tag >> 16) == 0xfffe;
    at = stated->content;
    if (!open && stated->length > bytes.size() - at) return false;
    if (tag == kEndOfSequence) {
      pieces = false;
      unknown = std::max(0, unknown - 1);
    }
    if (open && !item && (unknown > 0 || kind == "UN")) ++unknown;
    if (open && (kind == "OB" || kind == "OW")) pieces = true;
    const bool plain_sequence = !item && kind.empty() && bytes.size() - at >= 4 &&
                                stated->length >= 4 && tagAt(bytes, at) == kItem;
    const bool opens = open || (item && !pieces) || kind == "SQ" || plain_sequence;
    if (!opens) at += stated->length;
  }
  return true;
}

/// How a file says that its elements are written (PS3.5, annex A): GDCM reads them so, and takes a
/// length that stands in another way for gigabytes.
enum class Syntax { with_kinds, without_kinds, packed, large_byte_first };

Syntax syntaxNamed(const std::string& uid) {
  if (uid == "1.2.840.10008.1.2.1.99") return Syntax::packed;
  if (uid == "1.2.840.10008.1.2.2") return Syntax::large_byte_first;
  for (const char* known : {"1.2.840.10008.1.2.1", "1.2.840.10008.1.2.4.", "1.2.840.10008.1.2.5"})
    if (uid.starts_with(known)) return Syntax::with_kinds;
  return Syntax::without_kinds;
}

/// Walks the elements of a file as far as they are plain (explicit VR, little endian): known kinds,
/// rising tags, lengths that end inside the file. Debian's GDCM stops the program by an assertion
/// where some of this does not hold.
bool soundElements(const std::filesystem::path& file) {
  const std::string bytes = readWhole(file).value_or("");
  if (bytes.size() < 140 || bytes.compare(128, 4, "DICM") != 0) return false;
  std::uint32_t last = 0, meta = 0;
  Syntax syntax = Syntax::without_kinds;
  for (std::size_t at = 132; at < bytes.size();) {
    if (bytes.size() - at < 8) return false;
    const std::size_t element = at;
    std::uint16_t half[2];
    std::memcpy(half, &bytes[at], 4);
    const std::uint32_t tag = static_cast<std::uint32_t>(half[0]) << 16 | half[1];
    const std::string_view kind(&bytes[at + 4], 2);
    if (tag >= 0x00080000 && last < 0x00080000 && at != 144 + static_cast<std::size_t>(meta))
      return false;
    if (tag < 0x00080000 && (tag >> 16 != 2 || !among("ULOBUISHAE", kind))) return false;
    if (tag <= last || (tag >> 16) == 0xfffe ||
        (last < 0x00080000 && tag >= 0x00030000 && tag < 0x00080000))
      return false;
    std::uint32_t length = 0;
    if (among(kShortKinds, kind)) {
      std::uint16_t two;
      std::memcpy(&two, &bytes[at + 6], 2);
      length = two, at += 8;
    } else if (among(kLongKinds, kind) && bytes.size() - at >= 12) {
      std::memcpy(&length, &bytes[at + 8], 4);
      at += 12;
    } else {
      return tag >= 0x00080000 && last < 0x00080000 &&  // elements without kinds begin here
             (syntax == Syntax::packed ||
              (syntax == Syntax::without_kinds && lengthsFit(bytes, element, false)));
    }
    if (length == 0xffffffff)
      return (kind == "SQ" || kind == "OB" || kind == "OW" || kind == "UN") &&
             lengthsFit(bytes, element, true);
    if (length > bytes.size() - at) return false;
    if (tag >= 0x00080000 && syntax != Syntax::with_kinds) return false;
    if (tag == 0x00020000 && (length != 4 || kind != "UL")) return false;
    if (tag == 0x00020000) std::memcpy(&meta, &bytes[at], 4);
    if (kind == "US" && !sensible(tag, std::string_view(bytes).substr(at, length))) return false;
    if (tag == 0x00020010) syntax = syntaxNamed(trimmedText(bytes.substr(at, length)));
    last = tag;
    at += length;
  }
  return last >= 0x7fe00010;
}

/// Whether the file is a slice with a place; anything else in a folder is left alone.
bool readHead(const std::filesystem::path& file, Slice* slice) {
  if (!soundElements(file)) return false;
  gdcm::Reader reader;
  reader.SetFileName(file.string().c_str());
  if (!reader.ReadUpToTag(gdcm::Tag(0x7fe0, 0x0010))) return false;
  const gdcm::DataSet& data = reader.GetFile().GetDataSet();
  bool uid = false, place = false, turn = false, spacing = false, rows = false, columns = false,
       words = false;
  slice->file = file;
  slice->series = trimmedText(valueOf<0x0020, 0x000e>(data, &uid).GetValue());
  slice->words = trimmedText(valueOf<0x0008, 0x103e>(data, &words).GetValue());
  const auto origin = valueOf<0x0020, 0x0032>(data, &place);
  const auto axes = valueOf<0x0020, 0x0037>(data, &turn);
  const auto steps = valueOf<0x0028, 0x0030>(data, &spacing);
  slice->rows = valueOf<0x0028, 0x0010>(data, &rows).GetValue();
  slice->columns = valueOf<0x0028, 0x0011>(data, &columns).GetValue();
  if (!(uid && place && turn && spacing && rows && columns)) return false;
  for (unsigned a = 0; a < 3; ++a) {
    slice->origin_mm[static_cast<int>(a)] = origin.GetValue(a);
    slice->along_row[static_cast<int>(a)] = axes.GetValue(a);
    slice->along_column[static_cast<int>(a)] = axes.GetValue(a + 3);
  }
  slice->row_mm = steps.GetValue(0), slice->column_mm = steps.GetValue(1);
  slice->place_mm = slice->origin_mm.dot(slice->along_row.cross(slice->along_column));
  return slice->origin_mm.allFinite() && std::isfinite(slice->place_mm);
}

std::vector<std::filesystem::path> filesOf(const std::filesystem::path& folder) {
  std::vector<std::filesystem::path> files;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(folder))
    if (entry.is_regular_file()) files.push_back(entry.path());
  std::sort(files.begin(), files.end());
  if (files.size() > kMostFiles)
    refuseSeries("holds more than 5000 files", folder.string(), "Name the folder of one series");
  return files;
}

std::vector<Slice> chosen(std::map<std::string, std::vector<Slice>> all, const std::string& series,
                          const std::string& where) {
  if (all.empty())
    refuseSeries("holds no DICOM slices with a place", where,
                 "Name a folder with a CT series, or a .mha or .nii file");
  std::string list;
  int number = 0;
  for (auto& [uid, slices] : all) {
    ++number;
    list += (number > 1 ? "; " : "") + std::to_string(number) + ": \"" + slices.front().words +
            "\", " + std::to_string(slices.size()) + " slices";
    if (uid == series || std::to_string(number) == series) return slices;
  }
  if (!series.empty())
    refuseSeries("has no series \"" + series + "\" (" + list + ")", where,
                 "Take one of these for --ct-series");
  if (all.size() > 1)
    refuseSeries("holds " + std::to_string(all.size()) + " series (" + list + ")", where,
                 "Say which by --ct-series 1");
  return all.begin()->second;
}

/// Sorted by place; one orientation, one size, even steps.
void checkEven(std::vector<Slice>* slices, const std::string& where) {
  std::stable_sort(slices->begin(), slices->end(),
                   [](const Slice& a, const Slice& b) { return a.place_mm < b.place_mm; });
  if (slices->size() < 2)
    refuseSeries("has one slice only", where, "Name a folder with a whole series");
  std::vector<double> steps;
  for (std::size_t i = 1; i < slices->size(); ++i) {
    const Slice &a = (*slices)[i - 1], &b = (*slices)[i];
    if (a.rows != b.rows || a.columns != b.columns || (a.along_row - b.along_row).norm() > 1e-3 ||
        (a.along_column - b.along_column).norm() > 1e-3 || a.row_mm != b.row_mm ||
        a.column_mm != b.column_mm)
      refuseSeries("has slices of different size or direction", where,
                   "Name one series of parallel slices");
    steps.push_back(b.place_mm - a.place_mm);
  }
  const double usual = upperMedian(steps);
  for (std::size_t i = 0; i < steps.size(); ++i) {
    const std::string between =
        (*slices)[i].file.filename().string() + " and " + (*slices)[i + 1].file.filename().string();
    if (steps[i] < 0.01)
      refuseSeries("has two slices at one place (" + between + ")", where, "Remove the copies");
    if (std::abs(steps[i] - usual) > kUneven * usual)
      refuseSeries("lacks a slice or is uneven between " + between, where,
                   "Add the missing slices");
  }
}

std::vector<float> valuesOf(const Slice& slice, const std::string& where) {
  const std::size_t count =
      static_cast<std::size_t>(slice.rows) * static_cast<std::size_t>(slice.columns);
  gdcm::ImageReader reader;
  reader.SetFileName(slice.file.string().c_str());
  if (!reader.Read())
    refuseSeries("its picture cannot be read", slice.file.string(),
                 "Export the series again without compression");
  const gdcm::Image& image = reader.GetImage();
  static const std::map<int, VoxelType> kTypes{
      {gdcm::PixelFormat::INT8, VoxelType::int8},   {gdcm::PixelFormat::UINT8, VoxelType::uint8},
      {gdcm::PixelFormat::INT16, VoxelType::int16}, {gdcm::PixelFormat::UINT16, VoxelType::uint16},
      {gdcm::PixelFormat::INT32, VoxelType::int32}, {gdcm::PixelFormat::UINT32, VoxelType::uint32}};
  const gdcm::PixelFormat::ScalarType kind = image.GetPixelFormat().GetScalarType();
  const auto type = kTypes.find(kind == gdcm::PixelFormat::INT12    ? gdcm::PixelFormat::INT16
                                : kind == gdcm::PixelFormat::UINT12 ? gdcm::PixelFormat::UINT16
                                                                    : kind);
  const std::size_t size = type == kTypes.end() ? 0 : count * bytesOf(type->second);
  if (size == 0 || image.GetPixelFormat().GetSamplesPerPixel() != 1 ||
      image.GetBufferLength() != size)
    refuseSeries("is no single gray slice of the size it says", slice.file.string(),
                 "Name a CT series");
  std::string bytes(size, '\0');
  if (!image.GetBuffer(bytes.data()))
    refuseSeries("its picture is damaged", slice.file.string(), "Export the series again");
  return voxelsOf(bytes, type->second, count, false, image.GetSlope(), image.GetIntercept(), where);
}

}  // namespace

Volume readDicomSeries(const std::filesystem::path& path, const std::string& series) {
  gdcm::Trace::SetDebug(false), gdcm::Trace::SetWarning(false),
      gdcm::Trace::SetError(false);  // it is said in our words
  const bool folder = std::filesystem::is_directory(path);
  std::map<std::string, std::vector<Slice>> all;
  for (const std::filesystem::path& file :
       filesOf(folder                       ? path
               : path.parent_path().empty() ? "."
                                            : path.parent_path()))
    if (Slice slice; readHead(file, &slice)) all[slice.series].push_back(slice);
  std::string wanted = series;
  if (Slice slice; !folder && readHead(path, &slice)) wanted = slice.series;
  if (!folder && wanted.empty())
    refuseSeries("is no volume that is known", path.string(),
                 "Volumes are read from .mha, .mhd, .nii, .nii.gz and DICOM");
  std::vector<Slice> slices = chosen(std::move(all), wanted, path.string());
  checkEven(&slices, path.string());
  const Slice &first = slices.front(), &last = slices.back();
  Volume volume;
  volume.size = {first.columns, first.rows, static_cast<int>(slices.size())};
  volume.steps_S.col(0) = 1e-3 * first.column_mm * first.along_row;
  volume.steps_S.col(1) = 1e-3 * first.row_mm * first.along_column;
  volume.steps_S.col(2) =
      1e-3 * (last.origin_mm - first.origin_mm) / static_cast<double>(slices.size() - 1);
  volume.origin_S = 1e-3 * first.origin_mm;
  checkGeometry(volume, path.string());
  volume.values.reserve(static_cast<std::size_t>(first.columns) *
                        static_cast<std::size_t>(first.rows) * slices.size());
  for (const Slice& slice : slices) {
    const std::vector<float> values = valuesOf(slice, path.string());
    volume.values.insert(volume.values.end(), values.begin(), values.end());
  }
  return volume;
}

}  // namespace palpa::anatomy
