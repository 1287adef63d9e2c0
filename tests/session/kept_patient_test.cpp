#include "apps/session/needle_world.h"

#include <gtest/gtest.h>

#include <fstream>

#include "anatomy/base/whole_file.h"
#include "anatomy/patient/patient_file.h"
#include "apps/os/file_access.h"
#include "apps/station/assets.h"
#include "tests/support/counts.h"
#include "tests/support/setting.h"

namespace palpa::session {
namespace {

class KeptPatient : public testing::Test {
 protected:
  static anatomy::PatientParameters somebody(std::uint64_t seed) {
    static const anatomy::Population population =
        anatomy::readPopulation(station::assetFile("patients/reference.json").string());
    anatomy::PatientParameters p = anatomy::drawParameters(population, anatomy::Side::right, seed);
    p.extent = anatomy::Extent::bust;
    return p;
  }
  std::string bytesOf(std::uint64_t seed) const {
    return anatomy::glbOf(keptPatient(somebody(seed)), "a patient");
  }
  std::vector<std::filesystem::path> files() const {
    std::vector<std::filesystem::path> all;
    for (const auto& entry : std::filesystem::recursive_directory_iterator(here_.path()))
      if (entry.is_regular_file()) all.push_back(entry.path());
    return all;
  }

  const os::TemporaryFolder here_{"palpa-kept-"};
  const test::Setting cache_{"PALPA_CACHE", here_.path().c_str()};
};

TEST_F(KeptPatient, IsTheOneThatIsBuilt) {
  const std::string built = anatomy::glbOf(anatomy::buildPatient(somebody(4)), "a patient");
  EXPECT_EQ(bytesOf(4), built);
  ASSERT_EQ(files().size(), 1u);
  const auto written = std::filesystem::last_write_time(files().front());
  EXPECT_EQ(bytesOf(4), built);
  EXPECT_EQ(std::filesystem::last_write_time(files().front()), written);  // read, not built
  EXPECT_NE(bytesOf(5), built);
  EXPECT_EQ(files().size(), 2u);
}

TEST_F(KeptPatient, IsBuiltAnewWhereTheFileIsDamaged) {
  const std::string built = bytesOf(4);
  const std::filesystem::path file = files().at(0);
  const std::string whole = readWhole(file).value();
  const std::vector<std::size_t> places{64, whole.size() / 2, 3};
  for (int i = 0; i < test::counted(2, 3); ++i) {
    const std::size_t at = places.at(static_cast<std::size_t>(i));
    std::string damaged = whole;
    damaged[at] = static_cast<char>(damaged[at] ^ 1);
    if (at == 64) damaged.resize(at);
    std::ofstream(file, std::ios::binary) << damaged;
    EXPECT_EQ(bytesOf(4), built) << at;
    EXPECT_EQ(readWhole(file), whole) << at;
  }
}

TEST_F(KeptPatient, ComesWithoutAFolderToo) {
  const std::string built = bytesOf(4);
  const test::Setting nowhere("PALPA_CACHE", "/proc/none");
  EXPECT_EQ(bytesOf(4), built);
}

}  // namespace
}  // namespace palpa::session
