#include <gtest/gtest.h>

#include "anatomy/base/random.h"
#include "asset_files.h"

/// Damaged settings files: told in words or still valid, never a crash. Seeded: a failure can be
/// repeated.
namespace palpa::station {
namespace {

constexpr int kMutations = 2000;

std::string mutated(std::string text, RandomStream& random) {
  const auto somewhere = [&] {
    return static_cast<std::size_t>(random.uniform() * static_cast<double>(text.size()));
  };
  const int changes = 1 + static_cast<int>(random.uniform() * 4);
  for (int i = 0; i < changes; ++i) {
    const std::size_t at = somewhere();
    switch (static_cast<int>(random.uniform() * 4)) {
      case 0:
        text[at] = static_cast<char>(random.bits());
        break;  // any byte
      case 1:
        text[at] = "0123456789-.eE{}[]\",:"[random.bits() % 21];
        break;  // a byte that JSON knows
      case 2:
        text.erase(at, 1 + random.bits() % 8);
        break;
      default:
        text.insert(at, text.substr(somewhere(), 1 + random.bits() % 16));
    }
    if (text.empty()) text = " ";
  }
  return text;
}

class Damage : public testing::TestWithParam<AssetFile> {
 protected:
  void survive(const std::string& text, const std::string& how) {
    try {
      const Verdict verdict = judge(GetParam(), text);
      ++(verdict.valid ? valid_ : refused_);
      EXPECT_TRUE(verdict.valid || verdict.usage_error || !GetParam().is_json_file)
          << how << ": " << verdict.message;
      EXPECT_TRUE(verdict.valid || !verdict.message.empty());
    } catch (const std::exception& e) {
      ADD_FAILURE() << how << ": an error in no one's words: " << e.what();
    }
  }
  int valid_ = 0, refused_ = 0;
};

TEST_P(Damage, ChangedBytesAreToldOrValid) {
  const std::string text = GetParam().text();
  for (int i = 0; i < kMutations; ++i) {
    RandomStream random(static_cast<std::uint64_t>(i), "damage." + GetParam().name);
    survive(mutated(text, random), "mutation " + std::to_string(i));
  }
  EXPECT_GT(refused_, kMutations / 10);  // the damage is real ...
  EXPECT_GT(valid_, 0);                  // ... and not always total
}

TEST_P(Damage, CutShortIsTold) {
  const std::string text = GetParam().text();
  const std::size_t end = text.find_last_of('}');
  for (std::size_t length = 0; length <= end; length += 1 + end / 300)
    survive(text.substr(0, length), "cut to " + std::to_string(length) + " bytes");
  EXPECT_EQ(valid_, 0);
}

INSTANTIATE_TEST_SUITE_P(Assets, Damage, testing::ValuesIn(assetFiles()),
                         [](const auto& asset) { return testName(asset.param); });

}  // namespace
}  // namespace palpa::station
