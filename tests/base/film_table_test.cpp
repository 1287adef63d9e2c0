#include "anatomy/base/film_table.h"

#include <gtest/gtest.h>

#include <fstream>

#include "tests/support/scratch_folder.h"

namespace palpa {
namespace {

std::vector<FilmPicture> tableOf(const std::string& text) {
  const test::ScratchFolder place("film");
  std::ofstream(place / "room.mjpeg.csv") << text;
  return filmTable(place / "room.mjpeg");
}

TEST(FilmTable, TellsTimesAndPlaces) {
  const auto pictures = tableOf("number,t_exposure_ns,offset\n0,-5,0\n1,120,4711\n");
  ASSERT_EQ(pictures.size(), 2u);
  EXPECT_EQ(pictures[0].t_ns, -5);
  EXPECT_EQ(pictures[1].t_ns, 120);
  EXPECT_EQ(pictures[1].offset, 4711u);
}

TEST(FilmTable, OtherColumnsAreNoOffset) {
  const auto pictures = tableOf("number,t_exposure_ns,source,fault\n0,7,virtual camera,\n1,9,x,\n");
  ASSERT_EQ(pictures.size(), 2u);
  EXPECT_EQ(pictures[1].t_ns, 9);
  EXPECT_EQ(pictures[1].offset, 0u);
}

TEST(FilmTable, EndsWhereItTellsNoLongerWhatItShould) {
  for (const char* last : {"1", "1,", "1,30", "1,x,9", "1,30x,9", "1,30,", "1,30 4,9", ""})
    EXPECT_EQ(
        tableOf(std::string("number,t_exposure_ns,offset\n0,10,0\n") + last + "\n2,40,20\n").size(),
        1u)
        << last;
}

TEST(FilmTable, TakesSpacesOtherLineEndsAndAClockThatWentBack) {
  const auto pictures = tableOf("number,t_exposure_ns\r\n0, 100\r\n1, 90\r\n");
  ASSERT_EQ(pictures.size(), 2u);
  EXPECT_EQ(pictures[0].t_ns, 100);
  EXPECT_EQ(pictures[1].t_ns, 90);
}

TEST(FilmTable, WhereThereIsNoneIsEmpty) {
  EXPECT_TRUE(filmTable("nowhere/room.mjpeg").empty());
  EXPECT_TRUE(tableOf("").empty());
}

}  // namespace
}  // namespace palpa
