#include <gdcmAttribute.h>
#include <gdcmImageReader.h>
#include <gdcmReader.h>
#include <gdcmTrace.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "anatomy/base/error.h"
#include "anatomy/base/quantile.h"
#include "anatomy/base/whole_file.h"
#include "anatomy/volume/dicom_elements.h"
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

/// Whether the file is a slice with a place; anything else in a folder is left alone.
bool readHead(const std::filesystem::path& file, Slice* slice) {
  if (!soundDicomElements(readWhole(file).value_or(""))) return false;
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
