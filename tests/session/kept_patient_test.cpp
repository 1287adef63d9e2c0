#include "apps/session/needle_world.h"

#include <gtest/gtest.h>

#include <chrono>
#include <fstream>
#include <thread>

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

TEST_F(KeptPatient, LiesInTheUsersCacheUnlessItIsSwitchedOff) {
  const test::Setting home("XDG_CACHE_HOME", here_.path().c_str());
  {
    const test::Setting off("PALPA_CACHE", "off");
    bytesOf(4);
    EXPECT_TRUE(files().empty());
  }
  const test::Setting unset("PALPA_CACHE", nullptr);
  bytesOf(4);
  ASSERT_EQ(files().size(), 1u);
  EXPECT_EQ(files().front().parent_path(), here_.path() / "palpa/patients");
  EXPECT_EQ(os::privacyOf(files().front()), os::Privacy::own);
  EXPECT_EQ(os::privacyOf(here_.path() / "palpa"), os::Privacy::own);
}

class KeptFiles : public testing::Test {
 protected:
  /// Written so many minutes ago.
  std::filesystem::path put(const std::string& name, std::size_t bytes, int minutes) const {
    std::filesystem::path file = here_.path() / name;
    std::ofstream(file) << std::string(bytes, 'x');
    std::filesystem::last_write_time(
        file, std::filesystem::file_time_type::clock::now() - std::chrono::minutes(minutes));
    return file;
  }
  static std::string patient(int i) {
    const std::string number = std::to_string(i);
    return std::string(64 - number.size(), 'a') + number + ".glb";
  }
  std::uintmax_t bytes() const {
    std::uintmax_t sum = 0;
    for (const auto& entry : std::filesystem::directory_iterator(here_.path()))
      sum += entry.file_size();
    return sum;
  }

  const os::TemporaryFolder here_{"palpa-kept-"};
};

TEST_F(KeptFiles, TheOldestGoFirstAndOthersStay) {
  const auto young = put(patient(1), 100, 1), old = put(patient(2), 100, 30),
             older = put(patient(3), 100, 40), left = put('.' + patient(4) + ".part-17-0", 100, 50),
             foreign = put("notes.glb", 1000, 90);
  boundKept(here_.path(), 400);
  EXPECT_TRUE(std::filesystem::exists(left));
  boundKept(here_.path(), 299);
  EXPECT_FALSE(std::filesystem::exists(left));
  EXPECT_FALSE(std::filesystem::exists(older));
  EXPECT_TRUE(std::filesystem::exists(old));
  EXPECT_TRUE(std::filesystem::exists(young));
  EXPECT_TRUE(std::filesystem::exists(foreign));
  boundKept(here_.path() / "nowhere", 0);
}

TEST_F(KeptFiles, ProgramsMayBoundThemAtOnce) {
  for (int i = 0; i < 200; ++i) put(patient(i), 10, i);
  std::vector<std::thread> programs;
  for (int i = 0; i < 4; ++i) programs.emplace_back([this] { boundKept(here_.path(), 500); });
  for (std::thread& program : programs) program.join();
  EXPECT_LE(bytes(), 500u);
  EXPECT_TRUE(std::filesystem::exists(here_.path() / patient(0)));
}

}  // namespace
}  // namespace palpa::session
