#include <gtest/gtest.h>

#include "tests/headset/worn.h"

/// The last of this program: a runtime that hangs keeps its instance, and the loader gives no
/// second one.
namespace palpa::headset {
namespace {

/// A compositor that hangs holds nobody: the desktop's view and its keys go on at ten frames a
/// second, and after two seconds the headset is given up.
TEST(HeadsetUnanswered, OneThatHangsIsGivenUp) {
  Worn worn("eyes=64x64,64x64;fault=hung@6");
  EXPECT_EQ(worn.show(100), 6);
  EXPECT_TRUE(worn.view->trouble().find("does not answer") != std::string::npos)
      << worn.view->trouble();
  EXPECT_FALSE(worn.view->wait(true));
  worn.view.reset();  // what it holds cannot be given back
}

}  // namespace
}  // namespace palpa::headset
