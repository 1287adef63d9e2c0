#include "anatomy/base/json_fields.h"

#include <gtest/gtest.h>

#include "anatomy/base/json_text.h"

namespace palpa {
namespace {

using nlohmann::json;

TEST(JsonFields, RefuseWhatNobodyAskedFor) {
  const json object{{"a", 1}, {"b", {0.5, -2, 3}}, {"c\n", true}};
  JsonFields fields(object, "here", "");
  EXPECT_EQ(fields.numberOr("a", 0, 0, 2), 1);
  EXPECT_EQ(fields.triple("b", 3), (std::array<double, 3>{0.5, -2, 3}));
  EXPECT_THROW(fields.triple("b", 2.5), UsageError);
  EXPECT_THROW(fields.triple("a", 2.5), UsageError);
  EXPECT_THROW(fields.done(), UsageError);
  EXPECT_TRUE(fields.flagOr("c\n", false));
  fields.done();
}

TEST(JsonFields, AFileMayNameItsSchema) {
  const json object{{"$schema", "map.schema.json"}};
  JsonFields(object, "here", "").done();
  EXPECT_THROW(JsonFields(object, "here", "entries[0]").done(), UsageError);
  const json number{{"$schema", 1}};
  EXPECT_THROW(JsonFields(number, "here", "").done(), UsageError);
}

TEST(JsonText, IsParsedOrDiscarded) {
  EXPECT_EQ(parseJson("[1, 2]"), json::array({1, 2}));
  EXPECT_THROW(parseJson("[1, 2"), json::exception);
  EXPECT_TRUE(parsedOrDiscarded("").is_discarded());
  EXPECT_TRUE(parsedOrDiscarded("[1, 2").is_discarded());
  EXPECT_EQ(parsedOrDiscarded("{}"), json::object());
}

}  // namespace
}  // namespace palpa
