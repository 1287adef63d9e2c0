#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <nlohmann/json.hpp>
#include <optional>

#include "anatomy/base/error.h"
#include "anatomy/base/file_schema.h"
#include "anatomy/base/json_file.h"
#include "anatomy/base/units.h"
#include "anatomy/base/whole_file.h"
#include "calibration/parts/interactive_procedures.h"

namespace palpa::calibration {
namespace {

using Ordered = nlohmann::ordered_json;

constexpr int kLibraryVersion = 1;
constexpr double kMost_ms = 600'000;

/// Two thirds of the time a feature lies between the two figures of its range: a spread about its
/// centre, of logarithms by the same factor.
FeatureRange rangeIn(const JsonFile& file, const std::string& object, int feature) {
  const InteractionFeatureName& about = interactionFeatureName(feature);
  const std::string path = object + about.name;
  if (!file.has(path)) return {};
  const std::vector<double> ends = file.numbers(path);
  if (ends.size() != 2 || !(ends[0] < ends[1]) || (about.logarithm && !(ends[0] > 0)))
    file.refuse(path, about.logarithm ? "must be two figures above 0, the second the larger"
                                      : "must be two figures, the second the larger");
  const auto scaled = [&](double end) {
    return about.logarithm ? std::log(end * about.unit) : end * about.unit;
  };
  const double low = scaled(ends[0]), high = scaled(ends[1]);
  return {(low + high) / 2, (high - low) / 2};
}

std::vector<FeatureRange> rangesIn(const JsonFile& file, const std::string& object = "") {
  std::vector<FeatureRange> ranges;
  for (int d = 0; d < kInteractionFeatures; ++d) ranges.push_back(rangeIn(file, object, d));
  return ranges;
}

double rounded(double value) {
  char text[32];
  std::snprintf(text, sizeof text, "%.4g", value);
  return std::strtod(text, nullptr);
}

void addRanges(const std::vector<FeatureRange>& ranges, Ordered* object) {
  for (int d = 0; d < kInteractionFeatures; ++d) {
    const FeatureRange& range = ranges[static_cast<std::size_t>(d)];
    if (!(range.spread > 0)) continue;
    const InteractionFeatureName& about = interactionFeatureName(d);
    const auto end = [&](double value) {
      return rounded((about.logarithm ? std::exp(value) : value) / about.unit);
    };
    (*object)[about.name] = {end(range.centre - range.spread), end(range.centre + range.spread)};
  }
}

ProcedureProfile profileIn(const JsonFile& file) {
  return {file.text("from"), file.number("share", 1e-6, 1), file.number("seconds", 0, 1e7),
          rangesIn(file)};
}

ProcedureCue cueIn(const JsonFile& file) {
  const std::string kind = file.text("cue/kind");
  for (const char* known : kCueKinds)
    if (kind == known) return {kind, file.text("cue/means"), file.text("cue/source")};
  file.refuse("cue/kind", "is not a kind of augmentation");
}

InteractiveProcedure procedureIn(const JsonFile& file) {
  InteractiveProcedure p;
  p.name = file.text("name");
  p.means = file.text("means");
  p.source = file.text("source");
  p.cue = cueIn(file);
  p.least_s = 1e-3 * file.number("least_ms", 10, kMost_ms);
  p.mean_s = 1e-3 * file.number("mean_ms", 10, kMost_ms);
  if (p.mean_s < p.least_s) file.refuse("mean_ms", "is less than least_ms");
  for (const JsonFile& profile : file.entries("profiles")) p.profiles.push_back(profileIn(profile));
  if (p.profiles.empty()) file.refuse("profiles", "must hold one at least");
  return p;
}

LabelRule ruleIn(const JsonFile& file) {
  LabelRule rule;
  rule.task = file.text("task");
  if (file.has("parts")) rule.parts = file.texts("parts");
  if (file.has("part")) rule.part = file.integer("part", 0, 255);
  if (file.has("procedure")) rule.procedure = file.text("procedure");
  rule.why = file.text("why");
  return rule;
}

void requireKnown(const ProcedureLibrary& library, const JsonFile& file, const std::string& field,
                  const std::string& name) {
  if (library.indexOf(name) < 0)
    file.refuse(field, "names \"" + name + "\", which is no procedure");
}

ProcedureLibrary libraryIn(const JsonFile& file) {
  ProcedureLibrary library;
  library.source = file.text("source");
  library.made_by = file.text("made_by");
  library.simulated = file.flag("simulated");
  library.independent_s = 1e-3 * file.number("independent_ms", 10, kMost_ms);
  library.any = rangesIn(file, "any/");
  for (const FeatureRange& range : library.any)
    if (!(range.spread > 0)) file.refuse("any", "must name every feature");

  for (const JsonFile& one : file.entries("procedures")) {
    library.procedures.push_back(procedureIn(one));
    if (library.indexOf(library.procedures.back().name) + 1 !=
        static_cast<int>(library.procedures.size()))
      one.refuse("name", "stands twice");
  }
  for (const JsonFile& one : file.entries("labels")) {
    library.labels.push_back(ruleIn(one));
    if (!library.labels.back().procedure.empty())
      requireKnown(library, one, "procedure", library.labels.back().procedure);
  }
  return library;
}

Ordered toJson(const InteractiveProcedure& p) {
  Ordered object{{"name", p.name},
                 {"means", p.means},
                 {"source", p.source},
                 {"cue", {{"kind", p.cue.kind}, {"means", p.cue.means}, {"source", p.cue.source}}},
                 {"least_ms", rounded(1e3 * p.least_s)},
                 {"mean_ms", rounded(1e3 * p.mean_s)}};
  object["profiles"] = Ordered::array();
  for (const ProcedureProfile& profile : p.profiles) {
    Ordered one{{"from", profile.from},
                {"share", rounded(profile.share)},
                {"seconds", rounded(profile.seconds)}};
    addRanges(profile.features, &one);
    object["profiles"].push_back(one);
  }
  return object;
}

Ordered toJson(const LabelRule& rule) {
  Ordered object{{"task", rule.task}};
  if (!rule.parts.empty()) object["parts"] = rule.parts;
  if (rule.part >= 0) object["part"] = rule.part;
  if (!rule.procedure.empty()) object["procedure"] = rule.procedure;
  object["why"] = rule.why;
  return object;
}

}  // namespace

ProcedureLibrary readProcedures(const std::filesystem::path& path) {
  const JsonFile file(path);
  needKind(file, "interactive_procedures", kLibraryVersion);
  return libraryIn(file);
}

void writeProcedures(const ProcedureLibrary& library, const std::filesystem::path& path) {
  Ordered any = Ordered::object(), procedures = Ordered::array(), labels = Ordered::array();
  addRanges(library.any, &any);
  for (const InteractiveProcedure& p : library.procedures) procedures.push_back(toJson(p));
  for (const LabelRule& rule : library.labels) labels.push_back(toJson(rule));
  const Ordered all{{"version", kLibraryVersion},
                    {"source", library.source},
                    {"made_by", library.made_by},
                    {"simulated", library.simulated},
                    {"independent_ms", rounded(1e3 * library.independent_s)},
                    {"labels", labels},
                    {"procedures", procedures},
                    {"any", any}};
  writeWhole(path, all.dump(1) + "\n");
}

}  // namespace palpa::calibration
