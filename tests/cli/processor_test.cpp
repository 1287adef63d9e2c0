#include <gtest/gtest.h>

#include <optional>

#include "program.h"
#include "tests/support/counts.h"
#include "tests/support/setting.h"

/// A session recorded on one processor and replayed on another: the same bits. The other one is
/// played by taking away what the C library and OpenCV may use of this one. (Names of glibc up to
/// 2.32, and of later ones; unknown ones are ignored.)
namespace palpa::cli_test {
namespace {

class OlderProcessor {
 public:
  OlderProcessor()
      : libc_("GLIBC_TUNABLES",
              "glibc.cpu.hwcaps=-AVX2_Usable,-FMA_Usable,-FMA4_Usable,-AVX512F_Usable,-AVX2,-FMA,"
              "-FMA4,-AVX512F"),
        opencv_("OPENCV_CPU_DISABLE", "FMA3,AVX2,AVX512F,AVX512-SKX") {}

 private:
  test::Setting libc_, opencv_;
};

Outcome runOn(const std::vector<std::string>& arguments, const Folder& here, bool older) {
  std::optional<OlderProcessor> processor;
  if (older) processor.emplace();
  return palpa(arguments, here.path());
}

struct KindOfTask {
  const char* name;
  std::vector<std::string> words;
};

void PrintTo(const KindOfTask& task, std::ostream* out) { *out << task.name; }

class OnAnyProcessor : public ::testing::TestWithParam<KindOfTask> {};

/// In turn recorded with everything and replayed with less, and the other way round.
TEST_P(OnAnyProcessor, AReplayHasTheSameBits) {
  for (int i = 0; i < test::counted(1, 20); ++i) {
    const bool older = i % 2 == 0;
    const Folder here;
    std::vector<std::string> words = GetParam().words;
    const std::string seed = std::to_string(41 + i / 2);
    words.insert(words.end(), {"--operator", i % 4 < 2 ? "expert" : "novice", "--seed", seed,
                               "--trials", "1", "--out", "A"});
    const Outcome recorded = runOn(quickly(words), here, !older);
    ASSERT_EQ(recorded.exit_code, 0) << recorded.err;
    const Outcome replayed = runOn({"replay", "A/session.palpa"}, here, older);
    EXPECT_EQ(replayed.exit_code, 0) << replayed.err << replayed.out;
    EXPECT_TRUE(says(replayed.out, ": 0 differ")) << replayed.out;
    EXPECT_TRUE(says(replayed.out, "The replay equals the record")) << replayed.out;
  }
}

INSTANTIATE_TEST_SUITE_P(
    Tasks, OnAnyProcessor,
    ::testing::Values(KindOfTask{"subclavian", {"subclavian"}},
                      KindOfTask{"bone_pin",
                                 {"train", "--task",
                                  std::string(PALPA_SOURCE_DIR) + "/assets/tasks/bone_pin.json"}},
                      KindOfTask{"palpation", {"palpation", "--preset", "prostate"}},
                      KindOfTask{"search", {"search", "--mode", "augmented"}},
                      KindOfTask{"squeeze", {"squeeze"}}, KindOfTask{"friction", {"friction"}},
                      KindOfTask{"pulse", {"pulse"}}),
    [](const auto& task) { return std::string(task.param.name); });

}  // namespace
}  // namespace palpa::cli_test
