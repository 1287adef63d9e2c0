#include "anatomy/base/fonts.h"

#include <algorithm>
#include <span>
#include <utility>

#include "anatomy/base/text_forms.h"

namespace palpa {
namespace {

constexpr Font kDejaVu{
    .family = "DejaVu Sans",
    .plain = "/usr/share/fonts/truetype/dejavu/DejaVuSans.ttf",
    .bold = "/usr/share/fonts/truetype/dejavu/DejaVuSans-Bold.ttf",
    .package = "fonts-dejavu-core",
    .letters = "Greek and Cyrillic",
};
/// VTK 9.1 tells fonts apart by 16 bits of their files' names: it takes NanumGothic.ttf for
/// another.
constexpr Font kNanum{
    .family = "NanumBarunGothic",
    .plain = "/usr/share/fonts/truetype/nanum/NanumBarunGothic.ttf",
    .bold = "/usr/share/fonts/truetype/nanum/NanumBarunGothicBold.ttf",
    .package = "fonts-nanum",
    .letters = "Korean",
};

using Range = std::pair<char32_t, char32_t>;

/// Syllables of Hangul, their parts, and the signs and Chinese characters of Korean text.
constexpr Range kOfKorean[] = {{0x1100, 0x11ff}, {0x2e80, 0x9fff}, {0xa960, 0xa97f},
                               {0xac00, 0xd7ff}, {0xf900, 0xfaff}, {0xff00, 0xffef}};
/// Latin, Greek, Cyrillic, Armenian; Hebrew; Arabic; Georgian; signs.
constexpr Range kOfDejaVu[] = {{0x20, 0x7e},     {0xa1, 0x24f},    {0x386, 0x556},
                               {0x561, 0x587},   {0x5d0, 0x5ea},   {0x620, 0x64a},
                               {0x10d0, 0x10f0}, {0x1e00, 0x1fff}, {0x2010, 0x2027}};

bool isIn(char32_t letter, std::span<const Range> ranges) {
  return std::ranges::any_of(ranges, [letter](const Range& range) {
    return letter >= range.first && letter <= range.second;
  });
}

bool hasFile(const std::filesystem::path& root, std::string_view file) {
  std::error_code ignored;
  return std::filesystem::exists(root / file.substr(1), ignored);
}

}  // namespace

const Font& fontOf(std::string_view text) {
  const std::u32string letters = lettersOf(text);
  const auto is_korean = [](char32_t letter) { return isIn(letter, kOfKorean); };
  return std::ranges::any_of(letters, is_korean) ? kNanum : kDejaVu;
}

bool hasFont(char32_t letter) { return isIn(letter, kOfDejaVu) || isIn(letter, kOfKorean); }

bool isThere(const Font& font, const std::filesystem::path& root) {
  return hasFile(root, font.plain) && hasFile(root, font.bold);
}

}  // namespace palpa
