#include "include_circles.h"

#include <gtest/gtest.h>

namespace palpa::house {
namespace {

TEST(IncludeCircles, TheTreeHasNone) {
  const std::vector<SourceFile>& tree = sourceTree(PALPA_SOURCE_DIR);
  for (const std::string& circle : folderCircles(tree)) ADD_FAILURE() << circle;
  for (const std::string& circle : headerCircles(tree)) ADD_FAILURE() << circle;
}

TEST(IncludeCircles, PlantedOnesAreFound) {
  const std::vector<SourceFile> tree{{"a/x.h", "#include \"b/y.h\"\n"},
                                     {"b/y.h", "#include <vector>\n"},
                                     {"b/z.cpp", "#include \"c/w.h\"\n"},
                                     {"c/w.h", "#include \"a/x.h\"\n"}};
  ASSERT_EQ(folderCircles(tree).size(), 1u);
  EXPECT_EQ(folderCircles(tree)[0],
            "a -> b -> c -> a: a/x.h includes b/y.h, b/z.cpp includes c/w.h, c/w.h includes a/x.h");
  EXPECT_TRUE(headerCircles(tree).empty());  // no header needs itself
}

TEST(IncludeCircles, AFolderIsApartFromItsRooms) {
  EXPECT_TRUE(folderCircles({{"a/x.h", ""}, {"a/room/y.h", "#include \"a/x.h\"\n"}}).empty());
  EXPECT_EQ(folderCircles({{"a/x.h", ""},
                           {"a/z.cpp", "#include \"a/room/y.h\"\n"},
                           {"a/room/y.h", "#include \"a/x.h\"\n"}})
                .size(),
            1u);
}

TEST(IncludeCircles, HeadersInACircleAreFound) {
  EXPECT_EQ(
      headerCircles({{"a/x.h", "#include \"y.h\"\n"}, {"a/y.h", "#include \"a/x.h\"\n"}}).size(),
      1u);
}

}  // namespace
}  // namespace palpa::house
