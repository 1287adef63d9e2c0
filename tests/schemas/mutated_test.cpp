#include <gtest/gtest.h>

#include <algorithm>
#include <fstream>
#include <optional>

#include "anatomy/base/error.h"
#include "file_kinds.h"
#include "schema_files.h"
#include "tests/support/counts.h"
#include "tests/support/files.h"
#include "tests/support/hang_watch.h"
#include "tests/support/library_words.h"
#include "tests/support/little_memory.h"
#include "tests/support/mutations.h"
#include "tests/support/scratch_folder.h"

/// Files of every kind that nobody vouches for, seeded: each is read, or refused in our words with
/// file and place; in little memory, soon, and nothing is left beside it.
namespace palpa::schemas {
namespace {

namespace fs = std::filesystem;

constexpr std::chrono::seconds kLongest{10};
constexpr rlim_t kMemory = rlim_t{1} << 30;  // beyond what the process has already
constexpr double kNamesAPlace = 0.9;         // of those refused; a file may be no such file at all
constexpr int kMostToldInFull = 10;

int casesAKind() { return test::counted(200, 2000); }

/// What was said against a file; `is_ours`: by an error of the program's own.
struct Refusal {
  std::string words;
  bool is_ours = true;
};

std::optional<Refusal> refusalOf(const FileKind& kind, const fs::path& file) {
  const test::LittleMemory little(kMemory);
  try {
    kind.read(file);
    return std::nullopt;
  } catch (const Error& e) {
    return Refusal{e.what()};
  } catch (const std::exception& e) {
    return Refusal{e.what(), false};
  }
}

/// A field, a line, an entry, a row: where in the file to look.
bool namesAPlace(const std::string& words, const std::string& file) {
  static constexpr const char* kPlaces[] = {"field",  "\"",      "'",      "line ",    "entry ",
                                            "row ",   "column ", "table ", "byte",     "chunk",
                                            "header", "nested",  "empty",  "holds no", "cut"};
  const std::size_t name = words.find(file);
  constexpr std::size_t kSoon = 2000;
  if (name == std::string::npos) return false;
  const std::string after = words.substr(name + file.size(), kSoon);
  return std::any_of(std::begin(kPlaces), std::end(kPlaces),
                     [&](const char* place) { return after.find(place) != std::string::npos; });
}

std::vector<std::string> filesBelow(const fs::path& folder) {
  std::vector<std::string> files;
  for (const fs::directory_entry& entry : fs::recursive_directory_iterator(folder))
    files.push_back(entry.path().string());
  std::sort(files.begin(), files.end());
  return files;
}

class Mutated : public testing::TestWithParam<FileKind> {
 protected:
  Mutated() : folder_("mutated-" + GetParam().name) {
    for (const std::string& asset : shippedFiles())  // files refer to each other
      put({asset, test::slurp(assetsFolder() / asset)});
    for (const WholeSample& sample : kind().samples) put(sample);
  }

  const FileKind& kind() const { return GetParam(); }

  fs::path put(const WholeSample& sample) const {
    fs::path file = folder_ / sample.file;
    fs::create_directories(file.parent_path());
    std::ofstream(file, std::ios::binary) << sample.bytes;
    return file;
  }

  void tell(const std::string& what, const Refusal& refusal) {
    if (++told_ > kMostToldInFull) return;
    ADD_FAILURE() << what << ": " << refusal.words.substr(0, 400);
  }

  void place(const std::string& words, const std::string& file) {
    if (namesAPlace(words, file))
      ++placed_;
    else
      unplaced_ = words;
  }

  void judge(const Refusal& refusal, const fs::path& file) {
    ++refused_;
    if (!refusal.is_ours) return tell("an error in no one's words", refusal);
    const std::string line = refusal.words.substr(0, refusal.words.find('\n'));
    if (const std::string word = test::libraryWordsIn(line); !word.empty())
      tell("a library's words (" + word + ")", refusal);
    // Where one file refers to another, it may be that one which is not as it must be.
    const fs::path named = kind().is_folder ? file.parent_path() : file;
    if (line.find(named.string()) != std::string::npos)
      place(line, named.string());
    else if (line.find(folder_.path().string()) != std::string::npos)
      ++placed_;
    else
      tell("names no file", refusal);
  }

  test::ScratchFolder folder_;
  std::string unplaced_;  ///< the last that told no place
  int read_ = 0, refused_ = 0, placed_ = 0, told_ = 0;
};

TEST_P(Mutated, FilesAreReadOrRefusedInOurWords) {
  for (const WholeSample& sample : kind().samples) {
    const auto refusal = refusalOf(kind(), folder_ / sample.file);
    ASSERT_FALSE(refusal) << "the sound " << sample.file << ": " << refusal->words;
  }
  const std::vector<std::string> before = filesBelow(folder_.path());
  test::DamageDice dice(20'261'127);
  test::HangWatch watch(kLongest);
  for (int i = 0; i < casesAKind(); ++i) {
    const WholeSample& sample = kind().samples[dice.below(kind().samples.size())];
    std::string bytes = test::mutated(sample.bytes, dice);
    if (kind().seal) bytes = kind().seal(bytes);
    const fs::path file = put({sample.file, bytes});
    watch.begin(kind().name + ", file " + std::to_string(i));
    if (const auto refusal = refusalOf(kind(), file))
      judge(*refusal, file);
    else
      ++read_;
    put(sample);
  }
  EXPECT_GT(refused_, casesAKind() / 10) << "the damage is not real";
  EXPECT_GT(read_, 0) << "some damage does no harm";
  if (kind().has_places) {
    EXPECT_GE(placed_, kNamesAPlace * refused_) << "what is wrong, but not where: " << unplaced_;
  }
  EXPECT_LE(told_, kMostToldInFull) << "and more";
  EXPECT_EQ(filesBelow(folder_.path()), before) << "something was left behind";
}

INSTANTIATE_TEST_SUITE_P(Kinds, Mutated, testing::ValuesIn(everyFileKind()),
                         [](const auto& one) { return one.param.name; });

TEST(FileKinds, AreThirtyAtLeast) { EXPECT_GE(everyFileKind().size(), 30u); }

}  // namespace
}  // namespace palpa::schemas
