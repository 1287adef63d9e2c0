#include "anatomy/base/json_file.h"

#include <gtest/gtest.h>

#include <fstream>

#include "anatomy/base/error.h"
#include "tests/support/files.h"

namespace palpa {
namespace {

using nlohmann::json;

void expectUsageError(const std::string& text, const std::string& words) {
  const auto file = test::freshFolder("base", "json") / "a.json";
  std::ofstream(file) << text;
  try {
    JsonFile(file).number("x");
    ADD_FAILURE() << text << " was taken for valid";
  } catch (const UsageError& e) {
    EXPECT_NE(std::string(e.what()).find(words), std::string::npos) << e.what();
    EXPECT_NE(std::string(e.what()).find(file.string()), std::string::npos) << e.what();
  }
}

TEST(JsonFile, WhatIsNoNumberIsRefused) {
  expectUsageError("", "not valid JSON");
  expectUsageError("{\"x\": NaN}", "not valid JSON");
  expectUsageError("{\"x\": Infinity}", "not valid JSON");
  expectUsageError("{\"x\": 1e999}", "not valid JSON");
  expectUsageError("{\"x\": \"1\"}", "not a number");
  expectUsageError("{\"x\": {\"value\": null}}", "not a number");
  expectUsageError("{\"x\": {\"value\": 3, \"range\": [0, 2]}}", "outside its range");
  expectUsageError("{\"x\": {\"value\": 3, \"range\": [0]}}", "not [low, high]");
  expectUsageError("{\"x\": {\"value\": 3, \"range\": [0, \"2\"]}}", "not [low, high]");
  expectUsageError("[1, 2]", "is missing");
  expectUsageError("{\"x\": \"\xff\"}", "not valid JSON");
  expectUsageError(std::string(100'000, '[') + std::string(100'000, ']'), "nested too deep");
}

TEST(JsonFile, TextIsReadAsItsFileIs) {
  const std::string text = R"({"x": {"value": 3, "range": [0, 4]}, "t": "u"})";
  const auto name = test::freshFolder("base", "json") / "a.json";
  std::ofstream(name) << text;
  const JsonFile file(name), same = JsonFile::ofText(text, "the record, its task");
  EXPECT_EQ(same.json(), file.json());
  EXPECT_EQ(same.name(), "the record, its task");
  for (const std::string& wrong :
       {std::string(), std::string("{"), std::string(100'000, '['), std::string(5'000'000, ' ')})
    try {
      JsonFile::ofText(wrong, "the record, its task");
      ADD_FAILURE() << wrong.size() << " bytes were taken for valid";
    } catch (const UsageError& e) {
      EXPECT_EQ(std::string(e.what()).rfind("the record, its task: ", 0), 0u) << e.what();
    }
}

TEST(JsonFile, WhatIsNoFileIsRefused) {
  EXPECT_THROW(JsonFile("/nowhere/at.json"), UsageError);
  EXPECT_THROW(JsonFile{std::filesystem::temp_directory_path()}, UsageError);
  EXPECT_THROW(JsonFile("/dev/zero"), UsageError);
}

TEST(JsonFile, NumbersVectorsTextsRoundTrip) {
  const JsonFile file(json{{"a", {{"value", 2.5}, {"range", {2, 3}}}},
                           {"v", {1, 2, 3}},
                           {"t", {{"u", "w"}}},
                           {"n", 7},
                           {"b", true}},
                      "here");
  EXPECT_EQ(file.number("a"), 2.5);
  EXPECT_EQ(file.integer("n", 0, 10), 7);
  EXPECT_EQ(file.triple("v"), (std::array<double, 3>{1, 2, 3}));
  EXPECT_EQ(file.text("t/u"), "w");
  EXPECT_TRUE(file.has("t/u"));
  EXPECT_FALSE(file.has("t/u/v"));
  EXPECT_THROW(file.integer("a", 0, 10), UsageError);
  EXPECT_THROW(file.triple("t"), UsageError);
  EXPECT_THROW(file.text("n"), UsageError);
  EXPECT_TRUE(file.flag("b", false));
  EXPECT_TRUE(file.flag("missing", true));
  EXPECT_THROW(file.flag("n", false), UsageError);
  EXPECT_TRUE(file.flag("b"));
  EXPECT_THROW(file.flag("missing"), UsageError);
}

TEST(JsonFile, ListsAreReadWhole) {
  const JsonFile file(json{{"n", {1, 2.5}}, {"t", {"a", "b"}}, {"none", json::array()}}, "here");
  EXPECT_EQ(file.numbers("n"), (std::vector<double>{1, 2.5}));
  EXPECT_EQ(file.texts("t"), (std::vector<std::string>{"a", "b"}));
  EXPECT_TRUE(file.numbers("none").empty());
  EXPECT_THROW(file.numbers("t"), UsageError);
  EXPECT_THROW(file.texts("n"), UsageError);
  EXPECT_THROW(file.texts("missing"), UsageError);
}

TEST(JsonFile, SaysWhatToDo) {
  const JsonFile file(json{{"list", {{{"x", "a"}}}}}, "here", "Ask the author");
  try {
    file.entries("list").at(0).number("x");
    FAIL();
  } catch (const UsageError& e) {
    EXPECT_STREQ(e.what(), "here, \"list\", entry 1: field \"x\" is not a number. Ask the author");
  }
}

TEST(ReadOwnFile, AFaultInItIsNoMistakeInTheCall) {
  EXPECT_EQ(readOwnFile([] { return 7; }), 7);
  try {
    readOwnFile([] { JsonFile(json(), "here").number("x"); });
    FAIL();
  } catch (const UsageError&) {
    FAIL();
  } catch (const Error& e) {
    EXPECT_STREQ(e.what(), "here: field \"x\" is missing. Correct the file");
  }
}

}  // namespace
}  // namespace palpa
