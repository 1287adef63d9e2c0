#include "apps/task_comparison/comparison_file.h"

#include <cmath>

#include "anatomy/base/error.h"
#include "anatomy/base/file_schema.h"
#include "anatomy/base/json_text.h"
#include "anatomy/base/random.h"
#include "apps/training/engine.h"

namespace palpa::task_comparison {
namespace {

using assess::ComparedProperty;

std::vector<double> factorsIn(const JsonFile& file, const char* property) {
  constexpr double kLeast = 0.3,
                   kMost = 3;  // beyond, neither the device nor what was identified follows
  const std::string place = std::string("compare/") + property;
  if (!file.has(place)) return {};
  std::vector<double> factors = file.numbers(place);
  for (const double factor : factors)
    if (factor < kLeast || factor > kMost || std::abs(factor - 1) < 1e-3)
      file.refuse(place, "must hold numbers from 0.3 to 3, but not 1");
  return factors;
}

}  // namespace

ComparisonSettings readSqueeze(const std::filesystem::path& path) {
  const JsonFile file(path);
  training::needEngine(file, training::Engine::squeeze);
  needKind(file, "task_squeeze", 1);
  ComparisonSettings s;
  s.id = file.text("id");
  s.title = file.text("title");
  s.library = station::readLumps(path.parent_path() / file.text("lumps"));
  s.half = 1e-3 * file.number("object/half_mm", 10, 100);
  s.mass = 1e-3 * file.number("object/mass_g", 1, 200);
  s.stiffness = factorsIn(file, "stiffness");
  s.weight = factorsIn(file, "weight");
  if (s.stiffness.empty() && s.weight.empty())
    file.refuse("compare", "must hold \"stiffness\" or \"weight\"");
  s.touch = file.number("force/touch_N", 0.02, 5);
  s.too_hard = file.number("force/too_hard_N", 0.1, 50);
  s.time_limit_s = file.number("end/time_limit_s", 10, 3600);
  s.taxonomy = station::taxonomyOf(file);
  s.source = file.json().dump();
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
  RandomStream random(seed, "squeeze.comparisons");
  std::vector<Comparison> all;
  while (static_cast<int>(all.size()) < count) {
    for (std::size_t i = round.size(); i > 1; --i)
      std::swap(round[i - 1],
                round[static_cast<std::size_t>(random.uniform() * static_cast<double>(i)) % i]);
    all.insert(all.end(), round.begin(), round.end());
  }
  all.resize(static_cast<std::size_t>(count));
  return all;
}

std::string comparisonText(const Comparison& comparison) {
  return nlohmann::json{
      {"property", comparison.property == ComparedProperty::stiffness ? "stiffness" : "weight"},
      {"factors", comparison.factors}}
      .dump();
}

Comparison comparisonIn(const std::string& text) {
  try {
    const nlohmann::json said = parseJson(text);
    return {said.at("property").get<std::string>() == "weight" ? ComparedProperty::weight
                                                               : ComparedProperty::stiffness,
            said.at("factors").get<std::array<double, 2>>()};
  } catch (const nlohmann::json::exception& e) {
    throw Error("does not describe two things (" + whyNoJson(text, e) + ")", "event \"case\"",
                "Restore the file from a backup");
  }
}

}  // namespace palpa::task_comparison
