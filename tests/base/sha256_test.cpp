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

/// Known answers of PBKDF2 with HMAC-SHA-256 (RFC 6070's inputs).
TEST(Sha256, SlowlyWithSalt) {
  EXPECT_EQ(slowSha256("password", "salt", 1),
            "120fb6cffcf8b32c43e7225256c4f837a86548c92ccc35480805987cb70be17b");
  EXPECT_EQ(slowSha256("password", "salt", 4096),
            "c5e478d59288c841aa530db6845c4c8d962893a001ce4e11a4963873aa98134a");
}

}  // namespace
}  // namespace palpa
