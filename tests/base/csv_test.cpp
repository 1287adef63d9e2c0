#include "anatomy/base/text_forms.h"

#include <gtest/gtest.h>

namespace palpa {
namespace {

TEST(CsvField, IsQuotedOnlyWhereNeeded) {
  EXPECT_EQ(csvField("plain text"), "plain text");
  EXPECT_EQ(csvField("a,b"), "\"a,b\"");
  EXPECT_EQ(csvField("a \"b\""), "\"a \"\"b\"\"\"");
  EXPECT_EQ(csvField("a\nb"), "\"a\nb\"");
}

}  // namespace
}  // namespace palpa
