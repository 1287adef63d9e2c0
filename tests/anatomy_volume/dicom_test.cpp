#include <gdcmAttribute.h>
#include <gdcmImage.h>
#include <gdcmImageWriter.h>
#include <gdcmUIDGenerator.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>

#include "anatomy/geometry/error.h"
#include "anatomy/volume/readers.h"

namespace palpa::anatomy {
namespace {

/// Slices of a series in a folder of its own; slice n is filled with n * 10 - 1000 and counts up along rows.
class DicomSeries : public testing::Test {
 protected:
  void SetUp() override {
    folder_ = std::filesystem::temp_directory_path() / ("palpa_dicom_" + std::to_string(::getpid()));
    std::filesystem::remove_all(folder_);
    std::filesystem::create_directories(folder_);
  }
  void TearDown() override { std::filesystem::remove_all(folder_); }

  void write(int n, const std::string& series, const std::string& name) {
    gdcm::ImageWriter writer;
    gdcm::Image& image = writer.GetImage();
    image.SetNumberOfDimensions(2);
    const unsigned int size[2] = {6, 5};
    image.SetDimensions(size);
    image.SetSpacing(0, 0.8), image.SetSpacing(1, 0.9);
    const double origin[3] = {-12, 30, 100 + 2.5 * n};
    image.SetOrigin(origin);
    image.SetPixelFormat(gdcm::PixelFormat::INT16);
    image.SetPhotometricInterpretation(gdcm::PhotometricInterpretation::MONOCHROME2);
    image.SetIntercept(-1000), image.SetSlope(2);
    std::vector<std::int16_t> voxels(30);
    for (std::size_t i = 0; i < voxels.size(); ++i) voxels[i] = static_cast<std::int16_t>(5 * n + static_cast<int>(i % 6));
    gdcm::DataElement pixels(gdcm::Tag(0x7fe0, 0x0010));
    pixels.SetByteValue(reinterpret_cast<const char*>(voxels.data()), static_cast<std::uint32_t>(2 * voxels.size()));
    image.SetDataElement(pixels);
    gdcm::DataSet& data = writer.GetFile().GetDataSet();
    gdcm::Attribute<0x0008, 0x0016> kind;
    kind.SetValue("1.2.840.10008.5.1.4.1.1.2");
    data.Replace(kind.GetAsDataElement());
    gdcm::Attribute<0x0020, 0x000e> uid;
    uid.SetValue(series.c_str());
    data.Replace(uid.GetAsDataElement());
    gdcm::Attribute<0x0008, 0x103e> words;
    words.SetValue("chest");
    data.Replace(words.GetAsDataElement());
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
  for (int k = 0; k < 4; ++k) EXPECT_EQ(v.at(2, 1, k), -1000.f + 2 * (5 * static_cast<float>(k) + 2));
  EXPECT_EQ(readVolume(folder_ / "a.dcm").values, v.values);
}

TEST_F(DicomSeries, AMissingSliceIsNamed) {
  for (const int n : {0, 1, 2, 4, 5}) write(n, "1.2.3.4", std::to_string(n) + ".dcm");
  EXPECT_NE(complaint().find("lacks a slice or is uneven between 2.dcm and 4.dcm"), std::string::npos) << complaint();
}

TEST_F(DicomSeries, TwoSeriesAreNamedAndOneCanBeChosen) {
  for (int n = 0; n < 3; ++n) write(n, "1.2.3.4", "x" + std::to_string(n)), write(n + 7, "1.2.3.5", "y" + std::to_string(n));
  EXPECT_NE(complaint().find("holds 2 series (1: \"chest\", 3 slices; 2: \"chest\", 3 slices)"), std::string::npos) << complaint();
  EXPECT_EQ(readVolume(folder_, "2").at(0, 0, 0), -1000.f + 2 * 35);
  EXPECT_EQ(readVolume(folder_, "1.2.3.4").at(0, 0, 0), -1000.f);
  EXPECT_NE(complaint("3").find("has no series \"3\""), std::string::npos);
}

TEST_F(DicomSeries, AFolderWithoutSlicesIsSaid) { EXPECT_NE(complaint().find("holds no DICOM slices"), std::string::npos); }

}  // namespace
}  // namespace palpa::anatomy
