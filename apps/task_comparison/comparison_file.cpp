#include "apps/task_comparison/comparison_file.h"

#include <algorithm>
#include <cmath>

#include "anatomy/base/error.h"
#include "anatomy/base/file_schema.h"
#include "anatomy/base/json_text.h"
#include "anatomy/base/random.h"
#include "apps/training/engine.h"

namespace palpa::task_comparison {
namespace {

using assess::ComparedProperty;

// Beyond, neither the device nor what was identified follows
constexpr double kLeastFactor = 0.3, kMostFactor = 3;
constexpr double kSame = 1e-3;
constexpr std::size_t kFewestThings = 2, kMostThings = 8;  // of a comparison in the record

std::vector<double> factorsIn(const JsonFile& file, const char* property) {
  const std::string place = std::string("compare/") + property;
  if (!file.has(place)) return {};
  std::vector<double> factors = file.numbers(place);
  for (const double factor : factors)
    if (factor < kLeastFactor || factor > kMostFactor || std::abs(factor - 1) < kSame)
      file.refuse(place, "must hold numbers from 0.3 to 3, but not 1");
  return factors;
}

/// What every comparison's file says alike.
ComparisonSettings settingsOf(const JsonFile& file, training::Engine engine) {
  training::needEngine(file, engine);
  needKind(file, "task_" + training::nameOf(engine), 1);
  ComparisonSettings s;
  s.id = file.text("id");
  s.title = file.text("title");
  s.brief = station::briefOf(file);
  s.touch = file.number("force/touch_N", 0.02, 5);
  s.too_hard = file.number("force/too_hard_N", 0.1, 50);
  s.time_limit_s = file.number("end/time_limit_s", 10, 3600);
  s.taxonomy = station::taxonomyOf(file);
  s.source = file.json().dump();
  return s;
}

/// All different, and enough of them.
void readSorting(const JsonFile& file, ComparisonSettings* s) {
  constexpr int kFewest = 3, kMost = 6;  // two are a comparison; more nobody keeps in mind
  s->sorts = file.integer("sort/surfaces", kFewest, kMost);
  s->sorted = file.numbers("sort/friction");
  for (const double factor : s->sorted)
    if (factor < kLeastFactor || factor > kMostFactor)
      file.refuse("sort/friction", "must hold numbers from 0.3 to 3");
  std::vector<double> rising = s->sorted;
  std::sort(rising.begin(), rising.end());
  for (std::size_t i = 1; i < rising.size(); ++i)
    if (rising[i] - rising[i - 1] < kSame)
      file.refuse("sort/friction", "has the same number twice");
  if (s->sorted.size() < static_cast<std::size_t>(s->sorts))
    file.refuse("sort/friction", "must hold at least as many numbers as \"surfaces\" says");
  s->sort_limit_s = file.number("end/sort_limit_s", 10, 3600);
}

template <class Values>
void shuffle(Values& values, RandomStream& random) {
  for (std::size_t i = values.size(); i > 1; --i)
    std::swap(values[i - 1],
              values[static_cast<std::size_t>(random.uniform() * static_cast<double>(i)) % i]);
}

}  // namespace

ComparisonSettings readSqueeze(const std::filesystem::path& path) {
  const JsonFile file(path);
  ComparisonSettings s = settingsOf(file, training::Engine::squeeze);
  s.library = station::readLumps(path.parent_path() / file.text("lumps"));
  s.half = 1e-3 * file.number("object/half_mm", 10, 100);
  s.mass = 1e-3 * file.number("object/mass_g", 1, 200);
  s.stiffness = factorsIn(file, "stiffness");
  s.weight = factorsIn(file, "weight");
  if (s.stiffness.empty() && s.weight.empty())
    file.refuse("compare", "must hold \"stiffness\" or \"weight\"");
  return s;
}

ComparisonSettings readFriction(const std::filesystem::path& path) {
  const JsonFile file(path);
  ComparisonSettings s = settingsOf(file, training::Engine::friction);
  s.library = station::readLumps(path.parent_path() / file.text("lumps"));
  s.size =
      1e-3 * Vec3(file.number("phantom/across_mm", 10, 500),
                  file.number("phantom/away_mm", 10, 500), file.number("phantom/high_mm", 5, 300));
  s.friction = factorsIn(file, "friction");
  if (s.friction.empty()) file.refuse("compare", "must hold \"friction\"");
  readSorting(file, &s);
  return s;
}

std::vector<Comparison> comparisonsOf(const ComparisonSettings& settings, std::uint64_t seed,
                                      int count) {
  std::vector<Comparison> round;
  const auto add = [&round](ComparedProperty property, const std::vector<double>& factors) {
    for (const double factor : factors) {
      round.push_back({property, {1, factor}});
      round.push_back({property, {factor, 1}});
    }
  };
  add(ComparedProperty::stiffness, settings.stiffness);
  add(ComparedProperty::weight, settings.weight);
  add(ComparedProperty::friction, settings.friction);
  RandomStream random(seed,
                      settings.friction.empty() ? "squeeze.comparisons" : "friction.comparisons");
  std::vector<Comparison> all;
  while (static_cast<int>(all.size()) < count) {
    shuffle(round, random);
    all.insert(all.end(), round.begin(), round.end());
  }
  all.resize(static_cast<std::size_t>(count));
  return all;
}

std::vector<Comparison> sortingsOf(const ComparisonSettings& settings, std::uint64_t seed,
                                   int count) {
  RandomStream random(seed, "friction.sortings");
  std::vector<Comparison> all;
  std::vector<double> factors = settings.sorted;
  for (int i = 0; i < count; ++i) {
    shuffle(factors, random);
    all.push_back(
        {ComparedProperty::friction, {factors.begin(), factors.begin() + settings.sorts}});
  }
  return all;
}

std::string comparisonText(const Comparison& comparison) {
  return nlohmann::json{{"property", assess::nameOf(comparison.property)},
                        {"factors", comparison.factors}}
      .dump();
}

Comparison comparisonIn(const std::string& text) {
  std::string why;
  try {
    const nlohmann::json said = parseJson(text);
    const auto property = assess::propertyNamed(said.at("property").get<std::string>());
    const auto factors = said.at("factors").get<std::vector<double>>();
    if (property && factors.size() >= kFewestThings && factors.size() <= kMostThings)
      return {*property, factors};
    why = property ? "so many things are none" : "it names no property";
  } catch (const nlohmann::json::exception& e) {
    why = whyNoJson(text, e);
  }
  throw Error("does not describe things to compare (" + why + ")", "event \"case\"",
              "Restore the file from a backup");
}

}  // namespace palpa::task_comparison
