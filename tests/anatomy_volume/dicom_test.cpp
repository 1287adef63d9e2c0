#include <gdcmAttribute.h>
#include <gdcmWriter.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <iterator>
#include <random>

#include "anatomy/base/error.h"
#include "anatomy/volume/volume.h"
#include "tests/support/counts.h"
#include "tests/support/damage.h"

namespace palpa::anatomy {
namespace {

/// Slices of a series in a folder of its own; slice n is filled with n * 10 - 1000 and counts up
/// along rows.
class DicomSeries : public testing::Test {
 protected:
  void SetUp() override {
    folder_ =
        std::filesystem::temp_directory_path() / ("palpa_dicom_" + std::to_string(::getpid()));
    std::filesystem::remove_all(folder_);
    std::filesystem::create_directories(folder_);
  }
  void TearDown() override { std::filesystem::remove_all(folder_); }

  template <std::uint16_t group, std::uint16_t element, class Value>
  static void put(gdcm::DataSet* data, const Value& value) {
    gdcm::Attribute<group, element> attribute;
    attribute.SetValue(static_cast<typename gdcm::Attribute<group, element>::ArrayType>(value));
    data->Replace(attribute.GetAsDataElement());
  }
  template <std::uint16_t group, std::uint16_t element>
  static void puts(gdcm::DataSet* data, std::initializer_list<double> values) {
    gdcm::Attribute<group, element> attribute;
    unsigned int at = 0;
    for (const double value : values) attribute.SetValue(value, at++);
    data->Replace(attribute.GetAsDataElement());
  }

  void write(int n, const std::string& series, const std::string& name) {
    std::vector<std::int16_t> voxels(30);
    for (std::size_t i = 0; i < voxels.size(); ++i)
      voxels[i] = static_cast<std::int16_t>(5 * n + static_cast<int>(i % 6));
    gdcm::Writer writer;
    gdcm::DataSet& data = writer.GetFile().GetDataSet();
    put<0x0008, 0x0016>(&data, "1.2.840.10008.5.1.4.1.1.2");  // CT
    put<0x0008, 0x0018>(&data, (series + "." + std::to_string(n + 1)).c_str());
    put<0x0008, 0x103e>(&data, "chest");
    put<0x0020, 0x000e>(&data, series.c_str());
    puts<0x0020, 0x0032>(&data, {-12, 30, 100 + 2.5 * n});
    puts<0x0020, 0x0037>(&data, {1, 0, 0, 0, 1, 0});
    put<0x0028, 0x0002>(&data, 1);
    put<0x0028, 0x0004>(&data, "MONOCHROME2 ");
    put<0x0028, 0x0010>(&data, 5);
    put<0x0028, 0x0011>(&data, 6);
    puts<0x0028, 0x0030>(&data, {0.9, 0.8});
    put<0x0028, 0x0100>(&data, 16);
    put<0x0028, 0x0101>(&data, 16);
    put<0x0028, 0x0102>(&data, 15);
    put<0x0028, 0x0103>(&data, 1);
    put<0x0028, 0x1052>(&data, -1000);
    put<0x0028, 0x1053>(&data, 2);
    gdcm::DataElement pixels(gdcm::Tag(0x7fe0, 0x0010), 0, gdcm::VR::OW);
    pixels.SetByteValue(reinterpret_cast<const char*>(voxels.data()),
                        static_cast<std::uint32_t>(2 * voxels.size()));
    data.Insert(pixels);
    writer.GetFile().GetHeader().SetDataSetTransferSyntax(
        gdcm::TransferSyntax::ExplicitVRLittleEndian);
    writer.SetFileName((folder_ / name).string().c_str());
    ASSERT_TRUE(writer.Write());
  }

  std::string complaint(const std::string& series = "") const {
    try {
      readVolume(folder_, series);
    } catch (const Error& error) {
      return error.what();
    }
    return "";
  }

  std::filesystem::path folder_;
};

TEST_F(DicomSeries, ShuffledFilesComeBackInOrderWithSpacingAndHounsfield) {
  const char* names[] = {"c.dcm", "a.dcm", "d.dcm", "b.dcm"};
  for (int n = 0; n < 4; ++n) write(n, "1.2.3.4", names[n]);
  const Volume v = readVolume(folder_);
  ASSERT_EQ(v.size, (Index3{6, 5, 4}));
  EXPECT_EQ(axesOf(v), "LPS");
  EXPECT_LT((1e3 * v.spacing() - Vec3(0.8, 0.9, 2.5)).norm(), 1e-9);
  EXPECT_LT((1e3 * v.origin_S - Vec3(-12, 30, 100)).norm(), 1e-9);
  for (int k = 0; k < 4; ++k)
    EXPECT_EQ(v.at(2, 1, k), -1000.f + 2 * (5 * static_cast<float>(k) + 2));
  EXPECT_EQ(readVolume(folder_ / "a.dcm").values, v.values);
}

TEST_F(DicomSeries, AMissingSliceIsNamed) {
  for (const int n : {0, 1, 2, 4, 5}) write(n, "1.2.3.4", std::to_string(n) + ".dcm");
  EXPECT_NE(complaint().find("lacks a slice or is uneven between 2.dcm and 4.dcm"),
            std::string::npos)
      << complaint();
}

TEST_F(DicomSeries, TwoSeriesAreNamedAndOneCanBeChosen) {
  for (int n = 0; n < 3; ++n)
    write(n, "1.2.3.4", "x" + std::to_string(n)), write(n + 7, "1.2.3.5", "y" + std::to_string(n));
  EXPECT_NE(complaint().find("holds 2 series (1: \"chest\", 3 slices; 2: \"chest\", 3 slices)"),
            std::string::npos)
      << complaint();
  EXPECT_EQ(readVolume(folder_, "2").at(0, 0, 0), -1000.f + 2 * 35);
  EXPECT_EQ(readVolume(folder_, "1.2.3.4").at(0, 0, 0), -1000.f);
  EXPECT_NE(complaint("3").find("has no series \"3\""), std::string::npos);
}

TEST_F(DicomSeries, DamageGivesAVolumeOrAClearWord) {
  for (int n = 0; n < 3; ++n) write(n, "1.2.3.4", std::to_string(n) + ".dcm");
  std::ifstream stream(folder_ / "1.dcm", std::ios::binary);
  const std::string sound((std::istreambuf_iterator<char>(stream)), {});
  std::mt19937_64 bits(7);
  const int cases = palpa::test::counted(200, 2000);
  int read = 0, refused = 0;
  for (int i = 0; i < cases; ++i) {
    std::string bytes = sound;
    if (i % 5 == 0) bytes.resize(bits() % bytes.size());
    for (std::uint64_t n = 0, flips = 1 + bits() % 4; i % 5 && n < flips; ++n)
      bytes[bits() % bytes.size()] ^= static_cast<char>(1 << bits() % 8);
    std::ofstream(folder_ / "1.dcm", std::ios::binary) << bytes;
    try {
      const Volume v = readVolume(folder_);
      ASSERT_EQ(v.values.size(), static_cast<std::size_t>(v.size[0]) *
                                     static_cast<std::size_t>(v.size[1]) *
                                     static_cast<std::size_t>(v.size[2]));
      ++read;
    } catch (const Error&) {
      ++refused;
    }
  }
  EXPECT_GT(read, 0);
  EXPECT_GT(refused, 0);
  palpa::test::expectLessThan2GiB();
}

/// A length that the file does not have, or one that is read in another way, would take gigabytes.
TEST_F(DicomSeries, ASliceThatStatesMoreThanItHoldsIsLeftAlone) {
  const auto with = [&](const std::string& from, const std::string& to) {
    for (int n = 0; n < 5; ++n) write(n, "1.2.3", std::to_string(n));
    const std::filesystem::path file = folder_ / "2";  // what is left would be uneven
    std::ifstream in(file, std::ios::binary);
    std::string bytes{std::istreambuf_iterator<char>(in), {}};
    const std::size_t at = bytes.find(from);
    EXPECT_NE(at, std::string::npos);
    bytes.replace(at, from.size(), to);
    std::ofstream(file, std::ios::binary) << bytes;
    return complaint();
  };
  ASSERT_EQ(with("chest", "chest"), "");
  const std::string syntax = "1.2.840.10008.1.2.1", pixels("\xe0\x7f\x10\0OW\0\0", 8);
  EXPECT_NE(with(syntax, "1.2.840.10008.1.2.2"), "");
  EXPECT_NE(with(syntax + std::string(1, '\0'), "1.2.840.10008.1.2" + std::string(3, '\0')), "");
  EXPECT_NE(with(pixels, std::string("\xe0\x7f\x10\0XX\0\0", 8)), "");
  const std::string nested("\x30\x10SQ\0\0\xff\xff\xff\xff\xfe\xff\0\xe0\0\0\0\x70", 18);
  EXPECT_NE(with(std::string("\x30\0DS", 4), nested), "");
}

TEST_F(DicomSeries, AFolderWithoutSlicesIsSaid) {
  EXPECT_NE(complaint().find("holds no DICOM slices"), std::string::npos);
}

}  // namespace
}  // namespace palpa::anatomy
