#include <gtest/gtest.h>
#include <unistd.h>

#include <fstream>
#include <iterator>
#include <opencv2/imgproc.hpp>
#include <set>

#include "anatomy/base/error.h"
#include "ar/boards/board.h"

namespace palpa::ar {
namespace {

namespace fs = std::filesystem;

TEST(BoardSpec, KnowsItsKinds) {
  EXPECT_EQ(makeBoard("tags:6x4:0.030:0.0075")->describe(),
            "6 x 4 tag36h11 of 30 mm, 7.5 mm apart, ids from 0");
  EXPECT_EQ(makeBoard("tags:2x3:0.05:0.01:100")->describe(),
            "2 x 3 tag36h11 of 50 mm, 10 mm apart, ids from 100");
  EXPECT_EQ(makeBoard("chessboard:9x6:0.025")->describe(),
            "chessboard with 9 x 6 inner corners, squares of 25 mm");
  EXPECT_EQ(makeBoard("tag36h11:0.05")->describe(), "single tag36h11 of 50 mm");
  EXPECT_EQ(
      makeBoard("aprilgrid:6x6:0.088:0.3")->describe(),
      "AprilGrid of 6 x 6 tag36h11 of 88 mm with a border of 2 cells, 26.4 mm apart, ids from 0");
  EXPECT_EQ(
      makeBoard("aprilgrid:2x1:0.1:0.25:1")->describe(),
      "AprilGrid of 2 x 1 tag36h11 of 100 mm with a border of 1 cells, 25 mm apart, ids from 0");
  EXPECT_EQ(makeBoard("charuco:7x5:0.030:0.022:DICT_5X5_100")->describe(),
            "ChArUco board of 7 x 5 squares of 30 mm with markers of 22 mm, DICT_5X5_100");
  EXPECT_EQ(makeBoard("charuco:7x5:0.030:0.022")->describe(),
            "ChArUco board of 7 x 5 squares of 30 mm with markers of 22 mm, DICT_4X4_50");
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
                           "chessboard:9x6:0.025:x",
                           "chessboard:9x6:0.025:5:1",
                           "tag36h11",
                           "tag36h11:",
                           "tag36h11:0.05:3",
                           "tag16h5:0.05",
                           "tags:6x4:0.03:0.01:",
                           "aprilgrid",
                           "aprilgrid:6x6:0.088",
                           "aprilgrid:6x6:0.088:0.3:2:0",
                           "aprilgrid:6x6:0.088:0.3:two",
                           "aprilgrid:6x6:88mm:0.3",
                           "charuco:7x5",
                           "charuco:7x5:0.03:x",
                           "charuco:7x5:0.03:0.022:DICT_5X5_100:1",
                           "Tags:6x4:0.03:0.01"}) {
    try {
      makeBoard(spec);
      ADD_FAILURE() << "accepted '" << spec << "'";
    } catch (const UsageError& error) {
      for (const char* known :
           {"tags:6x4:0.030:0.0075", "aprilgrid:6x6:0.088:0.3", "chessboard:9x6:0.025",
            "charuco:7x5:0.030:0.022:DICT_5X5_100", "tag36h11:0.05", "FILE.yaml"})
        EXPECT_NE(std::string(error.what()).find(known), std::string::npos) << known;
    }
  }
}

TEST(BoardSpec, RefusesBoardsThatCannotWork) {
  for (const char* spec :
       {"tags:30x30:0.03:0.0075", "tags:6x4:0.03:0.0075:570", "tags:0x4:0.03:0.01",
        "tags:6x4:0.03:0.001", "tags:6x4:0.03:0.0075:-1", "chessboard:6x6:0.02",
        "chessboard:9x6:0.02:-1", "aprilgrid:6x6:0.088:0.05", "aprilgrid:6x6:0.088:nan",
        "aprilgrid:6x6:0.088:0.3:3", "aprilgrid:1x1:0.088:0.3", "aprilgrid:30x30:0.088:0.3",
        "charuco:2x5:0.03:0.02", "charuco:7x5:0.03:0.03", "charuco:7x5:0.03:0.005",
        "charuco:20x20:0.03:0.02:DICT_4X4_50", "charuco:7x5:0.03:0.02:DICT_9X9_50",
        "chessboard:9x1:0.02", "chessboard:999x6:0.02"})
    EXPECT_THROW(makeBoard(spec), UsageError) << spec;
  EXPECT_THROW(makeBoard("tag36h11:0.05", 0.5), UsageError);
}

/// A sheet with corner squares has white round those, too.
TEST(TagGrid, SheetsAreLargeEnough) {
  const TagGridSpec plain{2, 1, 0.10, 0.02, 0, 2, false}, squares{2, 1, 0.10, 0.02, 0, 2, true};
  EXPECT_LT((sheetSize(plain) - Eigen::Vector2d(0.26, 0.14)).norm(), 1e-12);
  EXPECT_LT((sheetSize(squares) - Eigen::Vector2d(0.30, 0.18)).norm(), 1e-12);
  const cv::Mat paper = drawTagGrid(squares, 100);  // a pixel a cell
  ASSERT_EQ(paper.size(), cv::Size(30, 18));
  EXPECT_EQ(cv::countNonZero(paper.rowRange(0, 2) != 255), 0);
  EXPECT_EQ(cv::countNonZero(paper.row(2) == 0), 3 * 2);  // three squares, two cells wide
  EXPECT_EQ(cv::countNonZero(paper.row(4) == 0), 2 * 10);
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

TEST(BoardDrawing, EveryWordCanBeDrawnAndIsFound) {
  for (const auto& [word, points] :
       {std::pair("tags:6x4:0.030:0.0075", 96), std::pair("aprilgrid:4x3:0.04:0.3", 48),
        std::pair("chessboard:9x6:0.025", 54), std::pair("charuco:7x5:0.030:0.022", 24),
        std::pair("tag36h11:0.05", 4)}) {
    cv::Mat paper = drawBoard(word, 2000);
    cv::blur(paper, paper, {3, 3});
    EXPECT_EQ(makeBoard(word, 1)->detect(paper).size(), std::size_t(points)) << word;
    EXPECT_THROW(drawBoard(word, 1), UsageError) << word;
    EXPECT_THROW(drawBoard(word, 1e7), UsageError) << word;
  }
  EXPECT_THROW(drawBoard("paper", 2000), UsageError);
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

TEST_F(BoardFile, MaySayThatBordersAreWiderAndCornersHaveSquares) {
  std::string text = table();
  text.insert(text.find("\"columns\""), "\"border_bits\": 2, \"corner_squares\": true, ");
  ASSERT_EQ(complaint(text), "");
  EXPECT_EQ(readTagGrid(file_).border_bits, 2);
  EXPECT_TRUE(readTagGrid(file_).corner_squares);
  text.replace(text.find("\"border_bits\": 2"), 16, "\"border_bits\": 3");
  EXPECT_NE(complaint(text).find("border_bits"), std::string::npos);
}

TEST_F(BoardFile, ACutFileIsRefused) {
  const std::string text = table();
  for (std::size_t n = 0; n < text.rfind('}'); ++n)
    EXPECT_NE(complaint(text.substr(0, n)), "") << n;
  EXPECT_THROW(readTagGrid("/no/such/board.json"), Error);
}

/// Kalibr's own example, comments and quotes included.
const char* const kTarget =
    "target_type: 'aprilgrid' #gridtype\n"
    "tagCols: 6               #number of apriltags\n"
    "tagRows: 5               #number of apriltags\n"
    "tagSize: 0.088           #size of apriltag, edge to edge [m]\n"
    "tagSpacing: 0.3          #ratio of space between tags to tagSize\n"
    "                         #example: tagSize=2m, spacing=0.5m --> tagSpacing=0.25[-]\n";

class KalibrFile : public BoardFile {
 protected:
  KalibrFile() { file_ += ".yaml"; }
};

TEST_F(KalibrFile, IsAnAprilGridWithBordersOfTwoCells) {
  ASSERT_EQ(complaint(kTarget), "");
  const TagGridSpec spec = readTagGrid(file_);
  EXPECT_EQ(spec.columns, 6);
  EXPECT_EQ(spec.rows, 5);
  EXPECT_EQ(spec.tag_size, 0.088);
  EXPECT_DOUBLE_EQ(spec.spacing, 0.0264);
  EXPECT_EQ(spec.first_id, 0);
  EXPECT_EQ(spec.border_bits, 2);
  EXPECT_TRUE(spec.corner_squares);
  EXPECT_EQ(makeBoard(file_.string())->describe(),
            makeBoard("aprilgrid:6x5:0.088:0.3")->describe());
}

TEST_F(KalibrFile, NamesTheKeyThatIsWrong) {
  const struct {
    const char *from, *to, *named;
  } damages[] = {{"'aprilgrid'", "'checkerboard'", "checkerboard"},
                 {"tagCols: 6", "tagCols: six", "tagCols"},
                 {"tagCols: 6", "tagCols: 6.5", "tagCols"},
                 {"tagCols: 6", "tagCols:", "tagCols"},
                 {"tagCols: 6", "tagCols: 600", "columns"},
                 {"tagCols: 6", "tagRows: 6", "twice"},
                 {"tagRows: 5", "", "tagRows"},
                 {"tagRows: 5", "tagRows 5", "key: value"},
                 {"0.088", "88", "tag_size"},
                 {"0.3 ", "0.01 ", "spacing"},
                 {"tagSize: 0.088", "tagSize: 0.088\nborder: 1", "border"},
                 {"target_type", "type", "target_type"}};
  for (const auto& damage : damages) {
    std::string text = kTarget;
    const std::string said =
        complaint(text.replace(text.find(damage.from), std::string(damage.from).size(), damage.to));
    EXPECT_NE(said.find(damage.named), std::string::npos) << damage.to << ": '" << said << "'";
  }
  EXPECT_NE(complaint(""), "");
  EXPECT_THROW(makeBoard("/no/such/target.yaml"), Error);
}

}  // namespace
}  // namespace palpa::ar
