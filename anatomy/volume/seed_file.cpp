#include "anatomy/volume/seed_file.h"

#include <algorithm>
#include <cstdio>
#include <nlohmann/json.hpp>

#include "anatomy/base/bytes.h"
#include "anatomy/base/error.h"
#include "anatomy/base/file_schema.h"
#include "anatomy/base/whole_file.h"

namespace palpa::anatomy {
namespace {

constexpr const char* kKnown[] = {"vein_svc",      "vein_axilla", "clavicle_right",
                                  "clavicle_left", "midline",     "suprasternal_notch",
                                  "entry_point",   "vein_target"};
constexpr double kFarthest_mm = 1e4;
constexpr const char* kSeedRemedy = "Let a run write a new one: give another name to --seeds";

bool known(const std::string& name) {
  return std::find(std::begin(kKnown), std::end(kKnown), name) != std::end(kKnown);
}

std::string knownNames() {
  std::string names;
  for (const char* name : kKnown) names += (names.empty() ? "" : ", ") + std::string(name);
  return names;
}

}  // namespace

Seeds readSeeds(const std::filesystem::path& file) {
  const auto fail = [&](const std::string& what) { throw Error(what, file.string(), kSeedRemedy); };
  const JsonFile whole =
      JsonFile::ofText(readWhole(file).value_or("{}"), file.string(), kSeedRemedy);
  const nlohmann::json& json = whole.json();
  if (!json.is_object() || json.value("format", nlohmann::json()) != "palpa-seeds" ||
      !json.contains("points") || !json["points"].is_object())
    fail("it is no file of seed points");
  refuseUnknownFields(whole, "seeds");
  if (json.value("unit", nlohmann::json()) != "mm") fail("its unit is not mm");
  Seeds seeds;
  for (const auto& [name, point] : json["points"].items()) {
    if (!known(name))
      fail("\"" + name.substr(0, 40) + "\" is no known point (" + knownNames() + ")");
    if (!point.is_array() || point.size() != 3) fail("\"" + name + "\" has not three numbers");
    for (int a = 0; a < 3; ++a) {
      const nlohmann::json& value = point[static_cast<std::size_t>(a)];
      if (!value.is_number() || !(std::abs(value.get<double>()) <= kFarthest_mm))
        fail("\"" + name + "\" has not three sensible numbers");
      seeds[name][a] = 1e-3 * value.get<double>();
    }
  }
  return seeds;
}

void writeSeeds(const Seeds& seeds, const std::filesystem::path& file) {
  nlohmann::json json{{"format", "palpa-seeds"},
                      {"unit", "mm"},
                      {"frame", "the volume's: x left, y posterior, z superior"}};
  for (const auto& [name, p] : seeds)
    json["points"][name] = {std::round(1e4 * p.x()) / 10, std::round(1e4 * p.y()) / 10,
                            std::round(1e4 * p.z()) / 10};
  writeWhole(file, json.dump(2) + "\n");
}

void addSeed(const std::string& text, Seeds* seeds) {
  const std::size_t equals = text.find('=');
  const std::string name = text.substr(0, equals);
  double x = 0, y = 0, z = 0;
  char more = 0;
  if (equals == std::string::npos ||
      std::sscanf(text.c_str() + equals + 1, "%lf,%lf,%lf%c", &x, &y, &z, &more) != 3 ||
      !(std::max({std::abs(x), std::abs(y), std::abs(z)}) <= kFarthest_mm))
    throw UsageError("is \"" + text + "\"", "--seed-point",
                     "Give name=x,y,z in mm, e.g. vein_svc=149.1,-201.1,-80");
  if (!known(name))
    throw UsageError("\"" + name + "\" is no known point", "--seed-point",
                     "Known: " + knownNames());
  (*seeds)[name] = 1e-3 * Vec3(x, y, z);
}

std::string seedOption(const std::string& name, const Vec3& p_S) {
  char text[160];
  std::snprintf(text, sizeof text, "--seed-point %s=%.1f,%.1f,%.1f", name.c_str(), 1e3 * p_S.x(),
                1e3 * p_S.y(), 1e3 * p_S.z());
  return text;
}

}  // namespace palpa::anatomy
