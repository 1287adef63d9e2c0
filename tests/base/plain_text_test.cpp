#include "anatomy/base/text_forms.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "tests/support/damage.h"

namespace palpa {
namespace {

constexpr std::size_t kMuch = 1000;

TEST(PlainText, WhatIsReadStays) {
  for (const char* text :
       {"", "it is full", "é ü ß 中文 λ 🙂", "~!\"#$%&'()*+,-./:;<=>?@[\\]^_`{|}"})
    EXPECT_EQ(plainText(text, kMuch), text);
}

TEST(PlainText, WhatATerminalWouldObeyIsShownAsAMark) {
  EXPECT_EQ(plainText("\x1b[2Jgone", kMuch), "?[2Jgone");
  EXPECT_EQ(plainText("a\r\nb\tc\ad\x7f", kMuch), "a??b?c?d?");
  EXPECT_EQ(plainText(std::string_view("a\0b", 3), kMuch), "a?b");
  EXPECT_EQ(plainText("\xc2\x9b"
                      "31m red",
                      kMuch),
            "?31m red")
      << "a control sequence of one byte";
  EXPECT_EQ(plainText("ab\xe2\x80\xae"
                      "dc",
                      kMuch),
            "ab?dc")
      << "written backwards from here";
  EXPECT_EQ(plainText("a\xe2\x80\xa8"
                      "b",
                      kMuch),
            "a?b")
      << "another line end";
}

TEST(PlainText, WhatIsNoUtf8IsAMarkForEachByte) {
  EXPECT_EQ(plainText("\xff\xfe", kMuch), "??");
  EXPECT_EQ(plainText("a\xc3", kMuch), "a?");
  EXPECT_EQ(plainText("\xc0\x9b", kMuch), "??") << "a control character in more bytes than it has";
  EXPECT_EQ(plainText("\xed\xa0\x80", kMuch), "???");
  EXPECT_EQ(plainText("\xf4\x90\x80\x80", kMuch), "????");
}

TEST(PlainText, IsNoLongerThanAskedAndEndsWithAWholeCharacter) {
  EXPECT_EQ(plainText("abcdef", 3), "abc");
  EXPECT_EQ(plainText("aéé", 4), "aé");
  EXPECT_EQ(plainText("abc", 0), "");
}

TEST(PlainText, OfAnyBytesNoneIsObeyed) {
  test::DamageDice dice(5);
  for (int i = 0; i < 2000; ++i) {
    std::string bytes(dice.below(60), '\0');
    for (char& c : bytes) c = static_cast<char>(dice.below(256));
    const std::string plain = plainText(bytes, 40);
    EXPECT_LE(plain.size(), 40u);
    EXPECT_TRUE(std::none_of(plain.begin(), plain.end(),
                             [](unsigned char c) { return c < 0x20 || c == 0x7f; }));
    EXPECT_EQ(plainText(plain, 40), plain) << "once is enough";
  }
}

}  // namespace
}  // namespace palpa
