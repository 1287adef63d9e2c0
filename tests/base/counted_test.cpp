#include "anatomy/base/counted.h"

#include <gtest/gtest.h>

namespace palpa {
namespace {

TEST(Counted, OneIsSingular) {
  EXPECT_EQ(counted(0, "trial"), "0 trials");
  EXPECT_EQ(counted(1, "trial"), "1 trial");
  EXPECT_EQ(counted(12, "scored trial"), "12 scored trials");
  EXPECT_EQ(howOften(0), "0 times");
  EXPECT_EQ(howOften(1), "once");
  EXPECT_EQ(howOften(2), "2 times");
  EXPECT_EQ(counted(-1, "trial"), "-1 trials") << "as signed as it is";
}

}  // namespace
}  // namespace palpa
