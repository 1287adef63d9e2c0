#include <gtest/gtest.h>

#include <fstream>
#include <sstream>

#include "anatomy/base/error.h"
#include "tests/expert_path/trials.h"

namespace palpa::calibration::test {
namespace {

namespace fs = std::filesystem;

class ExpertPathFile : public ::testing::Test {
 protected:
  void SetUp() override {
    folder_ = fs::path(::testing::TempDir()) /
              (std::string("expert_path_") +
               ::testing::UnitTest::GetInstance()->current_test_info()->name());
    fs::remove_all(folder_);
    fs::create_directories(folder_);
    file_ = folder_ / "path.json";
    path_ = fitExpertPath(drawTrials({}));
    path_.simulated = true;
    path_.made_by = "palpa calibrate experts --seed 1";
    writeExpertPath(path_, file_);
  }
  void TearDown() override { fs::remove_all(folder_); }

  std::string text() const {
    std::ostringstream all;
    all << std::ifstream(file_).rdbuf();
    return all.str();
  }
  /// Puts `now` in place of what stands after `"key": ` up to the end of that line.
  void setField(const std::string& key, const std::string& now) {
    std::string all = text();
    const std::size_t at = all.find("\"" + key + "\": ");
    ASSERT_NE(at, std::string::npos) << key;
    const std::size_t from = at + key.size() + 4;
    std::size_t to = all.find('\n', from);
    if (all[from] == '[')
      to = all.find(']', from) + 1;
    else if (all[to - 1] == ',')
      --to;
    all.replace(from, to - from, now);
    std::ofstream(file_) << all;
  }
  std::string complaint() const {
    try {
      readExpertPath(file_);
    } catch (const Error& error) {
      return error.what();
    }
    return "";
  }

  fs::path folder_, file_;
  ExpertPath path_;
};

TEST_F(ExpertPathFile, RoundTrips) {
  const ExpertPath back = readExpertPath(file_);
  // Metres to millimetres and back: two roundings of values below 0.1.
  EXPECT_LT((back.entry - path_.entry).norm(), 1e-16);
  EXPECT_LT((back.line_to - path_.line_to).norm(), 1e-16);
  EXPECT_LT((back.line_from - path_.line_from).norm(), 1e-16);
  EXPECT_LT((back.direction - path_.direction).norm(), 1e-15);
  EXPECT_NEAR(back.depth, path_.depth, 1e-17);
  EXPECT_NEAR(back.direction_acceptable, path_.direction_acceptable, 1e-15);
  EXPECT_NEAR(back.direction_sd, path_.direction_sd, 1e-15);
  EXPECT_NEAR(back.entry_sd, path_.entry_sd, 1e-17);
  EXPECT_NEAR(back.depth_sd, path_.depth_sd, 1e-17);
  EXPECT_NEAR(back.line_sd, path_.line_sd, 1e-17);
  EXPECT_NEAR(back.entry_acceptable, path_.entry_acceptable, 1e-17);
  EXPECT_NEAR(back.depth_acceptable, path_.depth_acceptable, 1e-17);
  EXPECT_NEAR(back.line_acceptable, path_.line_acceptable, 1e-17);
  EXPECT_EQ(back.axes, PathAxes::own_line);
  EXPECT_EQ(back.trials, path_.trials);
  EXPECT_EQ(back.left_out, path_.left_out);
  EXPECT_EQ(back.experts, path_.experts);
  EXPECT_EQ(back.made_by, path_.made_by);
  EXPECT_TRUE(back.simulated);
}

TEST_F(ExpertPathFile, ItsTextGivesTheSamePath) {
  const ExpertPath file = readExpertPath(file_), same = parseExpertPath(text(), "the record");
  EXPECT_EQ(same.source, text());
  EXPECT_EQ(file.source, text());
  EXPECT_EQ(same.entry, file.entry);
  EXPECT_EQ(same.line_to, file.line_to);
  EXPECT_EQ(same.direction_acceptable, file.direction_acceptable);
  EXPECT_EQ(same.experts, file.experts);
  for (const auto& [wrong, where] : {std::pair{"{}", "the record: field \"format\" is missing"},
                                     {"{", "the record: is not valid JSON"}})
    try {
      parseExpertPath(wrong, "the record");
      ADD_FAILURE() << wrong;
    } catch (const Error& error) {
      EXPECT_EQ(std::string(error.what()).rfind(where, 0), 0u) << error.what();
    }
}

TEST_F(ExpertPathFile, StatesUnitsInItsNames) {
  for (const char* key : {"entry_mm", "depth_mm", "direction_sd_deg", "line_to_mm"})
    EXPECT_NE(text().find(key), std::string::npos) << key;
}

TEST_F(ExpertPathFile, LeavesNothingBesideTheFile) {
  int files = 0;
  for (const auto& entry : fs::directory_iterator(folder_)) files += entry.exists();
  EXPECT_EQ(files, 1);
}

TEST_F(ExpertPathFile, NamesFileAndFieldOfEveryMistake) {
  const std::pair<const char*, const char*> mistakes[] = {{"entry_mm", "[0, 1]"},
                                                          {"depth_mm", "null"},
                                                          {"depth_mm", "-1"},
                                                          {"direction", "[0, 0, 0]"},
                                                          {"direction_acceptable_deg", "0"},
                                                          {"trials", "2.5"},
                                                          {"experts", "[1]"},
                                                          {"simulated", "1"},
                                                          {"format", "\"something else\""},
                                                          {"line_to_mm", "[\"a\", 0, 0]"}};
  const std::string good = text();
  for (const auto& [key, value] : mistakes) {
    std::ofstream(file_) << good;
    setField(key, value);
    EXPECT_NE(complaint().find(file_.string()), std::string::npos) << key << ": " << complaint();
    EXPECT_NE(complaint().find(key), std::string::npos) << key << ": " << complaint();
  }
}

TEST_F(ExpertPathFile, RefusesMissingFieldNewerVersionAndNonsense) {
  const std::string good = text();
  std::string without = good;
  without.replace(without.find("depth_mm"), 8, "depth_xx");
  std::ofstream(file_) << without;
  EXPECT_NE(complaint().find("field \"depth_xx\" is unknown (did you mean \"depth_mm\"?)"),
            std::string::npos)
      << complaint();
  std::ofstream(file_) << good;
  setField("version", "3");
  EXPECT_NE(complaint().find("newer"), std::string::npos) << complaint();
  std::ofstream(file_) << good.substr(0, good.size() / 2);
  EXPECT_NE(complaint().find("is not valid JSON"), std::string::npos);
  fs::remove(file_);
  EXPECT_NE(complaint().find("cannot be read"), std::string::npos);
}

/// As the program wrote it before: one path, in the landmarks' axes, for every body.
constexpr char kVersion1[] = R"({
  "format": "palpa expert path", "version": 1, "simulated": false, "made_by": "hand",
  "frame": "medial, posterior, cephalad", "trials": 30, "left_out": 1, "experts": ["A"],
  "entry_L_mm": [6.5, -8, -16], "entry_sd_mm": 1.4, "depth_mm": 10, "depth_sd_mm": 1,
  "direction_L": [0.6, 0.64, 0.48], "direction_sd_deg": 3, "direction_acceptable_deg": 6,
  "line_from_L_mm": [16, -4, -9], "line_to_L_mm": [29, 10, -2]
})";

TEST_F(ExpertPathFile, OfVersion1IsTheSameOnEveryBody) {
  const ExpertPath path = parseExpertPath(kVersion1, "the record");
  EXPECT_EQ(path.axes, PathAxes::landmarks);
  for (const TeachingLine& body :
       {TeachingLine{}, TeachingLine{{0.1, 0, 0}, Vec3::UnitZ(), {0.2, 0, 0}}}) {
    const TaughtPath taught = path.onBody(body);
    EXPECT_EQ(taught.entry_L, Vec3(1e-3 * Vec3(6.5, -8, -16)));
    EXPECT_EQ(taught.direction_L, path.direction);
    EXPECT_EQ(taught.line_from_L, path.line_from);
    EXPECT_EQ(taught.line_to_L, path.line_to);
  }
}

TEST_F(ExpertPathFile, RefusesALineWithoutLength) {
  std::string text = kVersion1;
  text.replace(text.find("[29, 10, -2]"), 12, "[16, -4, -9]");
  try {
    parseExpertPath(text, "the record");
    ADD_FAILURE() << "taken";
  } catch (const Error& error) {
    EXPECT_NE(std::string(error.what()).find("no length"), std::string::npos) << error.what();
  }
}

TEST_F(ExpertPathFile, AFailedWriteLeavesTheOldFile) {
  const std::string before = text();
  ExpertPath bad = path_;
  bad.depth = std::nan("");
  EXPECT_THROW(writeExpertPath(bad, file_), Error);
  EXPECT_EQ(text(), before);
  EXPECT_THROW(writeExpertPath(path_, folder_ / "no such folder" / "path.json"), Error);
}

}  // namespace
}  // namespace palpa::calibration::test
