#include <gtest/gtest.h>

#include <fstream>
#include <set>

#include "anatomy/base/error.h"
#include "damages.h"
#include "kinds.h"
#include "schema_files.h"
#include "schema_validator.h"
#include "tests/support/counts.h"
#include "tests/support/scratch_folder.h"

/// One schema, one reader: what either takes or refuses, the other does. A document of each kind is
/// damaged one field at a time, and both judge it.
namespace palpa::schemas {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;

constexpr int kMostToldOf = 20;

std::string nameOf(const testing::TestParamInfo<Kind>& info) { return info.param.name; }

/// The pattern that covers a damage; empty: none does.
std::string covering(const Exceptions& exceptions, const std::string& damage) {
  for (const std::string& pattern : exceptions)
    if (matches(damage, pattern)) return pattern;
  return "";
}

class Agreement : public testing::TestWithParam<Kind> {
 protected:
  Agreement()
      : folder_("schemas-" + GetParam().name),
        schema_(schemaOf(GetParam().name)),
        validator_(schema_) {
    for (const std::string& asset : shippedFiles())  // files refer to each other
      put(asset, withoutOwnRanges(jsonOf(assetsFolder() / asset)));
  }

  const Kind& kind() const { return GetParam(); }

  json documentOf(const Sample& sample) const {
    json document = json::object();
    if (fs::exists(assetsFolder() / sample.asset)) document = jsonOf(assetsFolder() / sample.asset);
    document.merge_patch(sample.more);
    return withoutOwnRanges(std::move(document));
  }

  void put(const std::string& asset, const json& document) const {
    const fs::path file = folder_ / asset;
    fs::create_directories(file.parent_path());
    std::ofstream(file, std::ios::binary) << document.dump();
  }

  /// What the reader says against a document; empty: nothing. An error that is not the program's
  /// own fails: whoever wrote the file could not act on it.
  std::string readersFault(const Sample& sample, json document) const {
    if (kind().seal) kind().seal(&document);
    put(sample.asset, document);
    try {
      kind().read(folder_ / sample.asset);
      return "";
    } catch (const Error& e) {
      return std::string("refused: ") + e.what();
    } catch (const std::exception& e) {
      ADD_FAILURE() << document.dump() << ": an error in no one's words: " << e.what();
      return "refused in no one's words";
    }
  }

  void compare(const Sample& sample, const std::string& damage, const json& document) {
    if (!covering(kind().elsewhere, damage).empty()) return;
    ++damages_;
    const std::string reader = readersFault(sample, document);
    const bool refused = !reader.empty();
    if (refused != validator_.accepts(document)) return;
    const std::string pattern = covering(refused ? kind().stricter : kind().forgiving, damage);
    used_.insert(pattern);
    if (!pattern.empty() || ++told_ > kMostToldOf) return;
    ADD_FAILURE() << sample.asset << damage << ": "
                  << (refused ? "the schema takes it, the reader " + reader
                              : "the reader takes it, the schema: " + validator_.faults(document));
  }

  test::ScratchFolder folder_;
  json schema_;
  SchemaValidator validator_;
  std::set<std::string> used_;  ///< patterns of exceptions
  int damages_ = 0, told_ = 0;
};

TEST_P(Agreement, SchemaAndReaderTakeAndRefuseTheSame) {
  const Limits limits = limitsIn(schema_);
  const int every = test::fullCounts() ? 1 : 2;
  int damage_number = 0;
  for (const Sample& sample : kind().samples) {
    const json document = documentOf(sample);
    ASSERT_EQ(readersFault(sample, document), "") << sample.asset;
    ASSERT_EQ(validator_.faults(document), "") << sample.asset;
    compare(sample, " with the schema's name", [&] {
      json named = document;
      named["$schema"] = "../schemas/" + kind().name + ".schema.json";
      return named;
    }());
    eachDamage(document, limits, [&](const std::string& damage, const json& changed) {
      if (damage_number++ % every == 0) compare(sample, damage, changed);
    });
  }
  EXPECT_GT(damages_, 40 / every) << "the damage is not real";
  EXPECT_LE(told_, kMostToldOf) << "and more";
  if (every > 1) return;  // an exception may be needed by what was left out
  for (const Exceptions* exceptions : {&kind().stricter, &kind().forgiving})
    for (const std::string& pattern : *exceptions)
      EXPECT_TRUE(used_.count(pattern)) << pattern << " is an exception that nothing needs";
}

INSTANTIATE_TEST_SUITE_P(Kinds, Agreement, testing::ValuesIn(everyKind()), nameOf);

TEST(Kinds, EverySchemaHasItsReader) {
  std::set<std::string> named{"task"};  // any of the five engines' schemas
  for (const Kind& kind : everyKind()) named.insert(kind.name);
  const std::vector<std::string> published = publishedKinds();
  EXPECT_EQ(std::set<std::string>(published.begin(), published.end()), named);
}

}  // namespace
}  // namespace palpa::schemas
