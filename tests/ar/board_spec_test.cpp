#include <gtest/gtest.h>
#include <unistd.h>

#include <fstream>
#include <iterator>
#include <set>

#include "anatomy/geometry/error.h"
#include "ar/board.h"

namespace palpa::ar {
namespace {

namespace fs = std::filesystem;

TEST(BoardSpec, KnowsItsThreeKinds) {
  EXPECT_EQ(makeBoard("tags:6x4:0.030:0.0075")->describe(),
            "6 x 4 tag36h11 of 30 mm, 7.5 mm apart, ids from 0");
  EXPECT_EQ(makeBoard("tags:2x3:0.05:0.01:100")->describe(),
            "2 x 3 tag36h11 of 50 mm, 10 mm apart, ids from 100");
  EXPECT_EQ(makeBoard("chessboard:9x6:0.025")->describe(),
            "chessboard with 9 x 6 inner corners, squares of 25 mm");
  EXPECT_EQ(makeBoard("tag36h11:0.05")->describe(), "single tag36h11 of 50 mm");
}

TEST(BoardSpec, SaysWhatIsKnownWhenItDoesNotUnderstand) {
  for (const char* spec : {"",
                           ":",
                           "tags",
                           "tags:",
                           "charuco:5x7:0.03",
                           "tags:6x4:0.03",
                           "tags:6x4:0.03:0.01:0:0",
                           "tags:6:0.03:0.01",
                           "tags:6x:0.03:0.01",
                           "tags:6x4x2:0.03:0.01",
                           "tags:6x4:30mm:0.01",
                           "tags:6x4:nan:0.01",
                           "tags:6x4:-0.03:0.01",
                           "tags:6x4:0.03:0.01:x",
                           "tags:6x4:0.03:0,01",
                           "chessboard:9x6",
                           "chessboard:9x6:0",
                           "chessboard:9x6:0.025:1",
                           "tag36h11",
                           "tag36h11:",
                           "tag36h11:0.05:3",
                           "tag16h5:0.05",
                           "tags:6x4:0.03:0.01:",
                           "Tags:6x4:0.03:0.01"}) {
    try {
      makeBoard(spec);
      ADD_FAILURE() << "accepted '" << spec << "'";
    } catch (const UsageError& error) {
      EXPECT_NE(std::string(error.what()).find("tags:6x4:0.030:0.0075"), std::string::npos);
      EXPECT_NE(std::string(error.what()).find("chessboard:9x6:0.025"), std::string::npos);
    }
  }
}

TEST(BoardSpec, RefusesBoardsThatCannotWork) {
  for (const char* spec : {"tags:30x30:0.03:0.0075", "tags:6x4:0.03:0.0075:570",
                           "tags:0x4:0.03:0.01", "tags:6x4:0.03:0.001", "tags:6x4:0.03:0.0075:-1",
                           "chessboard:6x6:0.02", "chessboard:9x1:0.02", "chessboard:999x6:0.02"})
    EXPECT_THROW(makeBoard(spec), UsageError) << spec;
  EXPECT_THROW(makeBoard("tag36h11:0.05", 0.5), UsageError);
}

TEST(TagGrid, CornersLieAsDescribed) {
  const TagGridSpec spec{3, 2, 0.04, 0.01, 10};
  Vec3 sum = Vec3::Zero();
  for (int id = 10; id < 16; ++id)
    for (const Vec3& p : tagCorners(spec, id)) sum += p;
  EXPECT_LT(sum.norm(), 1e-15);  // W's origin is the centre
  EXPECT_LT((tagCorners(spec, 10)[0] - Vec3(-0.07, -0.045, 0)).norm(), 1e-15);
  EXPECT_LT((tagCorners(spec, 11)[0] - Vec3(-0.02, -0.045, 0)).norm(), 1e-15);  // +x along the row
  EXPECT_LT((tagCorners(spec, 13)[0] - Vec3(-0.07, 0.005, 0)).norm(), 1e-15);   // then +y
  EXPECT_LT((tagCorners(spec, 15)[2] - Vec3(0.07, 0.045, 0)).norm(), 1e-15);
  EXPECT_LT((sheetSize(spec) - Eigen::Vector2d(0.16, 0.11)).norm(), 1e-15);
}

class BoardFile : public testing::Test {
 protected:
  BoardFile() : file_(fs::temp_directory_path() / ("palpa_board_" + std::to_string(getpid()))) {}
  ~BoardFile() override { fs::remove(file_); }

  std::string complaint(const std::string& text) const {
    std::ofstream(file_, std::ios::binary) << text;
    try {
      readTagGrid(file_);
      return "";
    } catch (const Error& error) {
      EXPECT_NE(std::string(error.what()).find(file_.string()), std::string::npos);
      return error.what();
    }
  }
  static std::string table() {
    std::ifstream in(fs::path(PALPA_SOURCE_DIR) / "assets/boards/table.json");
    return {std::istreambuf_iterator<char>(in), {}};
  }

  fs::path file_;
};

TEST_F(BoardFile, TheTableBoardIsTheDefault) {
  const TagGridSpec read = readTagGrid(fs::path(PALPA_SOURCE_DIR) / "assets/boards/table.json");
  const TagGridSpec spec;
  EXPECT_EQ(read.columns, spec.columns);
  EXPECT_EQ(read.rows, spec.rows);
  EXPECT_EQ(read.tag_size, spec.tag_size);
  EXPECT_EQ(read.spacing, spec.spacing);
  EXPECT_EQ(read.first_id, spec.first_id);
  EXPECT_LE(sheetSize(spec).x(), 0.297);  // A4, landscape
  EXPECT_LE(sheetSize(spec).y(), 0.210);
}

TEST_F(BoardFile, NamesTheFieldThatIsWrong) {
  const struct {
    const char *from, *to, *named;
  } damages[] = {{"\"version\": 1", "\"version\": 9", "version"},
                 {"tag36h11", "tag16h5", "family"},
                 {"\"columns\": 6", "\"columns\": 6.5", "columns"},
                 {"\"columns\": 6", "\"columns\": -6", "columns"},
                 {"\"columns\": 6", "\"columns\": \"six\"", "columns"},
                 {"\"columns\": 6", "\"columns\": 600", "columns"},
                 {"\"rows\"", "\"row\"", "rows"},
                 {"0.030", "30", "tag_size"},
                 {"0.030", "[0.03]", "tag_size_m"},
                 {"0.0075", "0.001", "spacing"},
                 {"\"first_id\": 0", "\"first_id\": 580", "ids"}};
  ASSERT_EQ(complaint(table()), "");
  for (const auto& damage : damages) {
    std::string text = table();
    const std::size_t at = text.find(damage.from);
    ASSERT_NE(at, std::string::npos) << damage.from;
    const std::string said =
        complaint(text.replace(at, std::string(damage.from).size(), damage.to));
    EXPECT_NE(said.find(damage.named), std::string::npos) << damage.to << ": '" << said << "'";
  }
}

TEST_F(BoardFile, ACutFileIsRefused) {
  const std::string text = table();
  for (std::size_t n = 0; n < text.rfind('}'); ++n)
    EXPECT_NE(complaint(text.substr(0, n)), "") << n;
  EXPECT_THROW(readTagGrid("/no/such/board.json"), Error);
}

}  // namespace
}  // namespace palpa::ar
