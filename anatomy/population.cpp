#include "anatomy/population.h"

#include <fstream>
#include <nlohmann/json.hpp>

#include "anatomy/geometry/error.h"

namespace palpa::anatomy {
namespace {

class Reference {
 public:
  explicit Reference(const std::string& file) : file_(file) {
    std::ifstream in(file);
    if (!in) fail("the file cannot be opened", "");
    try {
      json_ = nlohmann::json::parse(in);
    } catch (const nlohmann::json::exception& e) {
      fail(std::string("this is not JSON (") + e.what() + ")", "");
    }
  }

  double correlation(const char* key) const {
    const double r = value(entry(key), "r", key);
    if (!(r > -1 && r < 1)) fail("r is not between -1 and 1", key);
    return r;
  }

  /// `wanted_unit`: as the file must state it; `si`: what one of it is.
  Spread spread(const char* key, const char* wanted_unit = "mm", double si = 1e-3) const {
    const nlohmann::json& found = entry(key);
    const auto unit = found.find("unit");
    if (unit == found.end() || *unit != wanted_unit)
      fail(std::string("the unit is not \"") + wanted_unit + "\"", key);
    const auto range = found.find("range");
    if (range == found.end() || !range->is_array() || range->size() != 2)
      fail("the range is not two numbers", key);
    const Spread s{si * value(found, "mean", key), si * value(found, "sd", key),
                   si * number((*range)[0], key), si * number((*range)[1], key)};
    if (!(s.low <= s.mean && s.mean <= s.high && s.sd >= 0))
      fail("mean, sd and range contradict each other", key);
    return s;
  }

 private:
  [[noreturn]] void fail(const std::string& what, const std::string& key) const {
    throw Error(what, key.empty() ? file_ : file_ + ", \"" + key + "\"",
                "Compare with assets/patients/reference.json");
  }
  const nlohmann::json& entry(const char* key) const {
    const auto found = json_.is_object() ? json_.find(key) : json_.end();
    if (found == json_.end() || !found->is_object()) fail("the entry is missing", key);
    return *found;
  }
  double number(const nlohmann::json& json, const char* key) const {
    if (!json.is_number()) fail("a value is not a number", key);
    return json.get<double>();
  }
  double value(const nlohmann::json& entry, const char* field, const char* key) const {
    if (!entry.contains(field)) fail(std::string("\"") + field + "\" is missing", key);
    return number(entry[field], key);
  }

  std::string file_;
  nlohmann::json json_;
};

}  // namespace

Population readPopulation(const std::string& reference_json) {
  const Reference r(reference_json);
  Population p;
  p.height_women = r.spread("height_women", "m", 1);
  p.height_men = r.spread("height_men", "m", 1);
  p.bmi = r.spread("bmi", "kg/m2", 1);
  p.vein_depth = r.spread("vein_depth");
  p.vein_diameter = r.spread("vein_diameter");
  p.pleura_distance = r.spread("pleura_distance");
  p.clavicle_length = r.spread("clavicle_length");
  p.clavicle_thickness = r.spread("clavicle_thickness");
  p.skin_thickness = r.spread("skin_thickness");
  p.fat_share_women = r.spread("fat_share_women", "percent", 0.01);
  p.fat_share_men = r.spread("fat_share_men", "percent", 0.01);
  p.vein_depth_with_bmi = r.correlation("vein_depth_with_bmi");
  p.fat_share_with_bmi = r.correlation("fat_share_with_bmi");
  p.clavicle_length_with_height = r.correlation("clavicle_length_with_height");
  return p;
}

}  // namespace palpa::anatomy
