#include "anatomy/import/import_map.h"

#include <gtest/gtest.h>

#include <set>

#include "anatomy/base/error.h"

namespace palpa::anatomy {
namespace {

TEST(Axes, OfTheFortyEightTripletsHalfAreRightHanded) {
  int right = 0, left = 0, wrong = 0;
  const std::string letters = "LRAPSIX";
  std::set<std::string> turns;
  for (const char x : letters)
    for (const char y : letters)
      for (const char z : letters) {
        const std::string name{x, y, z};
        const auto axes = axesNamed(name);
        if (!axes) {
          ++wrong;
          continue;
        }
        const Mat3& R = axes->A_from_file;
        EXPECT_LT((R * R.transpose() - Mat3::Identity()).norm(), 1e-15) << name;
        EXPECT_EQ(axes->rightHanded(), R.col(0).cross(R.col(1)).dot(R.col(2)) > 0) << name;
        ++(axes->rightHanded() ? right : left);
      }
  EXPECT_EQ(right, 24);
  EXPECT_EQ(left, 24);
  EXPECT_EQ(wrong, 7 * 7 * 7 - 48);
  EXPECT_FALSE(axesNamed("LPSS") || axesNamed("lps") || axesNamed(""));
}

TEST(Axes, LettersSayWhereTheFilesAxesPoint) {
  EXPECT_EQ(axesNamed("LPS")->A_from_file, Mat3(Mat3::Identity()));
  const Mat3 gltf = axesNamed("LSA")->A_from_file;  // y up, z front
  EXPECT_EQ(gltf * Vec3(1, 2, 3), Vec3(1, -3, 2));
  EXPECT_EQ(axesNamed("RIP")->A_from_file * Vec3(1, 2, 3), Vec3(-1, 3, -2));
}

const char* const kWhole =
    R"({"format":"palpa-import-map","version":1,"name":"n","side":"left","unit":"mm","axes":"LPS",
 "licence":"CC0-1.0","source":"made here","entries":[{"file":"a.stl","id":"a","organ":"rib"},
 {"file":"b/c.glb","id":"b","organ":"airway","mesh":2,"unit":"m","axes":"LSA","scale":2,"translate_mm":[1,2,3],
  "colour":[0.5,0.25,1],"licence":"x","pieces":"largest","why":"w"}],
 "landmarks":{"entry_point":{"at":[1,2,3],"unit":"cm","axes":"LSA"}},"origin":{"at":[10,20,30]}})";

TEST(ImportMap, SaysWhatItSays) {
  const ImportMap map = parseImportMap(kWhole, "map");
  ASSERT_EQ(map.entries.size(), 2u);
  EXPECT_EQ(map.side, Side::left);
  EXPECT_EQ(map.entries[0].place({1, 2, 3}), Vec3(Vec3(1, 2, 3) * 1e-3));
  const MapEntry& b = map.entries[1];
  EXPECT_LT((b.place({1, 2, 3}) - Vec3(2.001, -5.998, 4.003)).norm(), 1e-12);
  EXPECT_EQ(*b.mesh_index, 2u);
  EXPECT_TRUE(b.largest_piece);
  EXPECT_EQ(b.rgba, (std::array<float, 4>{0.5f, 0.25f, 1, 1}));
  EXPECT_LT((map.landmarks.at("entry_point") - Vec3(0.01, -0.03, 0.02)).norm(), 1e-15);
  EXPECT_LT((*map.origin - Vec3(0.01, 0.02, 0.03)).norm(), 1e-15);
}

TEST(ImportMap, TheCommandLinesDefaultsStandBeforeTheMapsAndBehindTheEntrys) {
  const ImportMap map = parseImportMap(kWhole, "map", {"cm", "LSA"});
  EXPECT_STREQ(map.entries[0].unit.name, "cm");
  EXPECT_LT((map.entries[0].place({1, 2, 3}) - Vec3(0.01, -0.03, 0.02)).norm(), 1e-15);
  EXPECT_STREQ(map.entries[1].unit.name, "m");
}

/// With `from` replaced by `to`: refused, in one line that begins with the file and holds `word`.
void refused(const std::string& from, const std::string& to, const std::string& word) {
  std::string text = kWhole;
  ASSERT_NE(text.find(from), std::string::npos) << from;
  text.replace(text.find(from), from.size(), to);
  try {
    parseImportMap(text, "map");
    FAIL() << from << " -> " << to;
  } catch (const UsageError& error) {
    const std::string words = error.what();
    EXPECT_TRUE(words.starts_with("map: ") || words.starts_with("map, \"entries\", entry "))
        << words;
    EXPECT_EQ(words.find('\n'), std::string::npos) << words;
    EXPECT_NE(words.find(word), std::string::npos) << words;
  }
}

TEST(ImportMap, MistakesAreNamedByTheirField) {
  refused(R"("version":1)", R"("version":2)", "\"version\"");
  refused(R"("side":"left")", R"("side":"middle")", "\"side\"");
  refused(R"("name":"n",)", "", "\"name\" is missing");
  refused(R"("licence":"CC0-1.0",)", "", "\"licence\" is missing");
  refused(R"("unit":"mm",)", "", "\"entries[0].unit\"");
  refused(R"("axes":"LPS",)", "", "\"entries[0].axes\"");
  refused(R"("unit":"mm")", R"("unit":"furlong")", "mm, cm");
  refused(R"("axes":"LPS")", R"("axes":"LPP")", "\"entries[0].axes\"");
  refused(R"("axes":"LPS")", R"("axes":"RPS")", "mirrored");
  refused(R"("axes":"LPS")", R"("axes":"LPS","left_handed":true)", "right-handed");
  refused(R"("id":"b")", R"("id":"a")", "\"entries[1].id\"");
  refused(R"("organ":"rib")", R"("organ":"ribs")", "clavicle");
  refused(R"("file":"a.stl")", R"("file":"../a.stl")", "leads out");
  refused(R"("file":"a.stl")", R"("file":"/etc/a.stl")", "leads out");
  refused(R"("scale":2)", R"("scale":0)", "\"entries[1].scale\"");
  refused(R"("scale":2)", R"("scale":"2")", "\"entries[1].scale\"");
  refused(R"("scale":2)", R"("sclae":2)", "sclae");
  refused(R"([1,2,3],
  "colour")",
          R"([1,2],
  "colour")",
          "\"entries[1].translate_mm\"");
  refused("[0.5,0.25,1]", "[0.5,0.25,2]", "\"entries[1].colour\"");
  refused(R"("mesh":2)", R"("mesh":-2)", "\"entries[1].mesh\"");
  refused(R"("pieces":"largest")", R"("pieces":"some")", "\"entries[1].pieces\"");
  refused(R"("at":[1,2,3])", R"("at":[1,2,1e400])", "JSON");
  refused(R"("entries":[{)", R"("entries":[[[[[[[[[[[[[[[[[[{)", "nested too deep");
  refused(R"("unit":"cm")", R"("unit":"ell")", "landmarks");
}

TEST(ImportMap, ALeftHandedFileSaysSo) {
  std::string text = kWhole;
  text.replace(text.find(R"("axes":"LPS")"), 12, R"("axes":"RPS","left_handed":true)");
  const ImportMap map = parseImportMap(text, "map");
  EXPECT_FALSE(map.entries[0].axes.rightHanded());
  EXPECT_TRUE(map.entries[1].axes.rightHanded()) << "its own axes, which are not";
}

}  // namespace
}  // namespace palpa::anatomy
