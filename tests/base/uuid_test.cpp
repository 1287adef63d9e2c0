#include "anatomy/base/uuid.h"

#include <gtest/gtest.h>

#include "anatomy/base/error.h"

namespace palpa {
namespace {

TEST(Uuid, HasVersionAndVariant) {
  EXPECT_EQ(uuidFrom({0, 1, 2, 3, 4, 5, 0xff, 7, 0xff, 9, 10, 11, 12, 13, 14, 15}),
            "00010203-0405-4f07-bf09-0a0b0c0d0e0f");
  EXPECT_NE(newUuid(), newUuid());
}

TEST(Uuid, OfANameKnowsTheVectorOfRfc9562) {
  const std::string dns = "6ba7b810-9dad-11d1-80b4-00c04fd430c8";
  EXPECT_EQ(uuidOfName(dns, "www.example.com"), "2ed6657d-e927-568b-95e1-2665a8aea6a2");
  EXPECT_EQ(uuidOfName("6BA7B810-9DAD-11D1-80B4-00C04FD430C8", "www.example.com"),
            "2ed6657d-e927-568b-95e1-2665a8aea6a2");
  EXPECT_EQ(uuidOfName("0191e2f1-1b2c-4d3e-8f40-123456789abc", "trial 7"),
            "f4a0796b-6718-562c-888e-90444365e832");
}

TEST(Uuid, WhatIsNone) {
  EXPECT_TRUE(isUuid(newUuid()));
  for (const char* none :
       {"", "u1", "{6ba7b810-9dad-11d1-80b4-00c04fd430c}", "6ba7b810-9dad-11d1-80b4+00c04fd430c8",
        "6ba7b8109dad11d180b400c04fd430c86ba7", "6ba7b810-9dad-11d1-80b4-00c04fd430g8"}) {
    EXPECT_FALSE(isUuid(none)) << none;
    EXPECT_THROW(uuidOfName(none, "x"), Error) << none;
  }
}

}  // namespace
}  // namespace palpa
