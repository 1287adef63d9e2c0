#include "anatomy/base/fonts.h"

#include <gtest/gtest.h>

#include <string>

#include "anatomy/base/text_forms.h"

namespace palpa {
namespace {

TEST(Fonts, AKoreanTextIsDrawnInNanumAndEveryOtherInDejaVu) {
  EXPECT_STREQ(fontOf("Depth 12.3 mm").family, "DejaVu Sans");
  EXPECT_STREQ(fontOf("Βάθος, глубина, profondité").family, "DejaVu Sans");
  EXPECT_STREQ(fontOf("깊이 12.3 mm").family, "NanumBarunGothic");
  EXPECT_STREQ(fontOf("").family, "DejaVu Sans");
}

TEST(Fonts, AKeysLetterIsShownWhereAFontHasIt) {
  for (const char32_t letter : {U'Q', U'Ω', U'Я', U'Ö', U'ㅂ', U'א'}) EXPECT_TRUE(hasFont(letter));
  for (const char32_t letter : {U'\u0001', U'\u0e01', U'\u0915'}) EXPECT_FALSE(hasFont(letter));
}

TEST(Letters, AreReadFromUtf8AndEachBrokenByteIsMarked) {
  EXPECT_EQ(lettersOf("aΩ한"), U"aΩ한");
  EXPECT_EQ(lettersOf("a\xff"
                      "b"),
            U"a\ufffd"
            "b");
  EXPECT_EQ(lettersOf("\xed\x95"), U"\ufffd\ufffd");
}

}  // namespace
}  // namespace palpa
