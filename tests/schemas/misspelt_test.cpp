#include <gtest/gtest.h>

#include <fstream>
#include <iostream>
#include <map>
#include <set>
#include <utility>

#include "anatomy/base/error.h"
#include "damages.h"
#include "kinds.h"
#include "schema_files.h"
#include "tests/support/counts.h"
#include "tests/support/scratch_folder.h"

/// A mistyped key is never taken in silence: of every shipped file every key in turn.
namespace palpa::schemas {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;

constexpr double kProposedShare = 0.95;
constexpr int kMostTakenTold = 20;
/// Each key in every way in which it is misspelt here, or in one.
const bool kEverySlip = palpa::test::counted(0, 1) == 1;

struct Tally {
  int misspelt = 0, refused = 0, proposed = 0;
};

/// The kind by whose reader a shipped file is read.
std::string readersKind(const std::string& asset) {
  for (const std::string& kind : kindsOf(asset))
    if (kind != "task") return kind;
  return "task_" + jsonOf(assetsFolder() / asset).at("engine").get<std::string>();
}

bool proposes(const std::string& words, const std::string& right) {
  return words.find("did you mean \"" + right + "\"?") != std::string::npos ||
         words.find("field \"" + right + "\" is missing; did you mean it by") != std::string::npos;
}

class Misspelt : public testing::Test {
 protected:
  Misspelt() : folder_("misspelt") {
    for (const Kind& kind : everyKind()) kinds_.emplace(kind.name, kind);
    for (const std::string& asset : shippedFiles())  // files refer to each other
      put(asset, jsonOf(assetsFolder() / asset));
  }

  void put(const std::string& asset, const json& document) const {
    const fs::path file = folder_ / asset;
    fs::create_directories(file.parent_path());
    std::ofstream(file, std::ios::binary) << document.dump();
  }

  bool isFree(const Kind& kind, const std::string& place) {
    for (const std::string& pattern : kind.free)
      if (matches(place, pattern)) {
        used_.insert(kind.name + pattern);
        return true;
      }
    return false;
  }

  void tell(const std::string& words) {
    if (++told_ <= kMostTakenTold) ADD_FAILURE() << words;
  }

  void judge(const Kind& kind, const std::string& asset, const Mistyped& key) {
    Tally& tally = tallies_[kind.name];
    ++tally.misspelt;
    const std::string what = asset + ": " + key.place + " as " + key.wrong;
    try {
      kind.read(folder_ / asset);
      tell(what + " is taken in silence");
    } catch (const UsageError& e) {
      ++tally.refused;
      if (proposes(e.what(), key.right)) ++tally.proposed;
    } catch (const std::exception& e) {
      tell(what + " is no mistake in the call (exit code 2): " + e.what());
    }
  }

  test::ScratchFolder folder_;
  std::map<std::string, Kind> kinds_;
  std::map<std::string, Tally> tallies_;
  std::set<std::string> used_;
  int told_ = 0;
};

TEST_F(Misspelt, EveryKeyOfEveryShippedFileIsRefusedAndTheRightOneProposed) {
  for (const std::string& asset : shippedFiles()) {
    const Kind& kind = kinds_.at(readersKind(asset));
    const json document = jsonOf(assetsFolder() / asset);
    std::string last;
    eachMisspelling(document, [&](const Mistyped& key, const json& changed) {
      const bool again = std::exchange(last, key.place) == key.place;
      if (isFree(kind, key.place) || (again && !kEverySlip)) return;
      put(asset, changed);
      judge(kind, asset, key);
    });
    put(asset, document);
  }
  Tally all;
  for (const auto& [kind, tally] : tallies_) {
    std::cout << kind << ": " << tally.misspelt << " misspelt, " << tally.refused << " refused, "
              << tally.proposed << " proposed\n";
    all.misspelt += tally.misspelt;
    all.refused += tally.refused;
    all.proposed += tally.proposed;
  }
  EXPECT_GT(all.misspelt, kEverySlip ? 10'000 : 3'000) << "the walk has lost the keys";
  EXPECT_EQ(all.refused, all.misspelt);
  EXPECT_GE(all.proposed, kProposedShare * all.misspelt);
  for (const auto& [name, kind] : kinds_)
    for (const std::string& pattern : kind.free)
      EXPECT_TRUE(used_.count(name + pattern)) << pattern << " is free, but nothing needs it";
}

}  // namespace
}  // namespace palpa::schemas
