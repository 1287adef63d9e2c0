#include "anatomy/base/sha256.h"

#include <gtest/gtest.h>

#include "anatomy/base/error.h"
#include "tests/support/files.h"

namespace palpa {
namespace {

TEST(Sha256, OfTheStandardsExample) {
  EXPECT_EQ(sha256("abc"), "ba7816bf8f01cfea414140de5dae2223b00361a396177a9cb410ff61f20015ad");
  EXPECT_EQ(sha256(""), "e3b0c44298fc1c149afbf4c8996fb92427ae41e4649b934ca495991b7852b855");
}

TEST(Sha256, OfAFile) {
  const auto folder = test::freshFolder("base", "sha256");
  std::ofstream(folder / "abc") << "abc";
  EXPECT_EQ(sha256OfFile(folder / "abc"), sha256("abc"));
  EXPECT_THROW(sha256OfFile(folder / "missing"), UsageError);
}

}  // namespace
}  // namespace palpa
