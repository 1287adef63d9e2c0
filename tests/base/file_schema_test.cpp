#include "anatomy/base/file_schema.h"

#include <gtest/gtest.h>

#include <fstream>
#include <iterator>

#include "anatomy/base/error.h"
#include "anatomy/base/json_text.h"

namespace palpa {
namespace {

using nlohmann::json;

std::string fieldRefused(const json& document, const std::string& kind) {
  try {
    refuseUnknownFields(JsonFile(document, "a.json"), kind);
    return "";
  } catch (const UsageError& e) {
    return e.what();
  }
}

bool says(const std::string& text, const std::string& words) {
  return text.find(words) != std::string::npos;
}

TEST(FileSchema, TheProgramHoldsThePublishedTexts) {
  const std::string folder = std::string(PALPA_SOURCE_DIR) + "/assets/schemas/";
  ASSERT_GT(schemaTexts().size(), 20u);
  for (const SchemaText& schema : schemaTexts()) {
    std::ifstream file(folder + std::string(schema.kind) + ".schema.json", std::ios::binary);
    const std::string text{std::istreambuf_iterator<char>(file), {}};
    EXPECT_EQ(schema.text, text) << schema.kind;
  }
}

TEST(FileSchema, AnUnknownFieldIsNamedWithItsPlaceAndWhatWasMeant) {
  const std::string said = fieldRefused({{"safety", {{"deadman_buton", 1}}}}, "station");
  EXPECT_TRUE(says(said,
                   "a.json: field \"safety/deadman_buton\" is unknown (did you mean "
                   "\"deadman_button\"?)"))
      << said;
  EXPECT_EQ(fieldRefused({{"safety", {{"deadman_button", 1}}}}, "station"), "");
  EXPECT_TRUE(
      says(fieldRefused({{"safety", {{"xyzzy", 1}}}}, "station"), "is unknown; known here: "));
}

TEST(FileSchema, ALongNameIsUnknownAndEndsNothing) {
  EXPECT_TRUE(says(fieldRefused({{"safety", {{std::string(100'000, 'x'), 1}}}}, "station"),
                   "is unknown; known here: "));
}

TEST(FileSchema, FiguresHaveTheirFieldsThroughReferences) {
  const std::string said = fieldRefused(
      {{"end", {{"time_limit_s", {{"value", 60}, {"rangz", {1, 2}}}}}}}, "task_needle");
  EXPECT_TRUE(says(said, "\"end/time_limit_s/rangz\"")) << said;
  EXPECT_TRUE(says(said, "did you mean \"range\"?")) << said;
}

TEST(FileSchema, EntriesOfListsAreCountedFromOne) {
  const json document{{"boards", {{{"name", "a"}}, {{"nmae", "b"}}}}};
  const std::string said = fieldRefused(document, "station");
  EXPECT_TRUE(says(said, "a.json, \"boards\", entry 2: field \"nmae\"")) << said;
  EXPECT_TRUE(says(said, "did you mean \"name\"?")) << said;
}

TEST(FileSchema, BranchesCountTogether) {
  EXPECT_EQ(fieldRefused({{"scoring", {{"dwell_s", 1}}}}, "task_needle"), "");
  EXPECT_TRUE(says(fieldRefused({{"scoring", {{"dwel_s", 1}}}}, "task_needle"), "\"dwell_s\""));
  EXPECT_TRUE(says(fieldRefused({{"engin", "search"}}, "task"), "did you mean \"engine\"?"));
}

TEST(FileSchema, RemarksMayStandAnywhereThatPeopleWrite) {
  EXPECT_EQ(fieldRefused({{"camera", {{"about", "x"}, {"lens_source", "y"}}}}, "station"), "");
  EXPECT_NE(fieldRefused({{"camera", {{"abuot", "x"}}}}, "station"), "");
}

TEST(FileSchema, FreeNamesStayFree) {
  EXPECT_EQ(fieldRefused({{"parameters", {{"anything_at_all", {1, 2}}}}}, "calibration"), "");
  EXPECT_EQ(fieldRefused(json::array({1, 2}), "station"), "");
}

TEST(FileSchema, AFieldThatIsStillMissingIsProposedFirst) {
  const json item{{"id", "a"}, {"question", "?"}, {"kid", "text"}};
  const std::string said = fieldRefused({{"items", {item}}}, "questionnaire");
  EXPECT_TRUE(says(said, "did you mean \"kind\"?")) << said;
}

TEST(NeedKind, AsksForTheVersionBeforeTheFieldsOfALaterOne) {
  const auto complaint = [](const json& document) -> std::string {
    try {
      needKind(JsonFile(document, "a.json"), "presentation", 1);
      return "";
    } catch (const UsageError& e) {
      return e.what();
    }
  };
  EXPECT_TRUE(says(complaint({{"version", 2}, {"new_field", 1}}), "is newer than this program"));
  EXPECT_TRUE(says(complaint({{"vresion", 1}}), "did you mean \"version\"?"));
  EXPECT_TRUE(says(complaint({{"name", "x"}}), "\"version\" is missing"));
  EXPECT_EQ(complaint({{"version", 1}}), "");
}

TEST(WhyNoJson, SaysLineColumnAndWhatIsWrong) {
  const auto why = [](const std::string& text) -> std::string {
    try {
      parseJson(text);
      return "";
    } catch (const json::exception& e) {
      return whyNoJson(text, e);
    }
  };
  EXPECT_EQ(why("{\n \"a\": 1\n \"b\": 2}"),
            "line 3, column 4: a comma or } is missing before this");
  EXPECT_EQ(why("[1 2]"), "line 1, column 4: a comma or ] is missing before this");
  EXPECT_EQ(why("{\"a\" 1}"), "line 1, column 6: a colon is missing before this");
  EXPECT_EQ(why("{\"x\": 1e999}"), "line 1, column 7: the number 1e999 is too large");
  EXPECT_EQ(why("{\"a\": [1"),
            "line 1, column 9: the text ends before everything that was opened is closed");
  EXPECT_TRUE(says(why("{\"\xc3\xa4\": NaN}"), "line 1, column 7: here must be a number"));
  EXPECT_TRUE(says(why("{\"x\": \"\xff\"}"), "a letter is damaged"));
  EXPECT_TRUE(says(why("{\"a\": 1,}"), "a field's name in quotation marks"));
  EXPECT_TRUE(says(why("{} 1"), "more follows after the end"));
  for (const char* text : {"", "{", "nul", "[1,]", "{1: 2}", "\"\\q\"", "-", "[1.]", "/**/1"})
    EXPECT_FALSE(says(why(text), "parse") || says(why(text), "json.exception")) << why(text);
}

TEST(WhyNoJson, HasWordsForWhatHoldsSomethingElse) {
  try {
    json{{"a", "text"}}.at("a").get<int>();
    FAIL() << "a text was taken for a number";
  } catch (const json::exception& e) {
    EXPECT_EQ(whyNoJson("{}", e), "a field is missing, or holds something else than it must");
  }
}

}  // namespace
}  // namespace palpa
