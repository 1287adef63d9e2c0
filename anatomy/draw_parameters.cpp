#include <fstream>
#include <nlohmann/json.hpp>

#include "anatomy/geometry/error.h"
#include "anatomy/parametric/feasibility.h"
#include "anatomy/parametric_patient.h"
#include "anatomy/random_stream.h"

namespace palpa::anatomy {
namespace {

constexpr int kMostTries = 200;

struct Spread {
  double mean, sd, low, high;  // metres
};

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

  Spread spread(const char* key) const {
    const auto entry = json_.is_object() ? json_.find(key) : json_.end();
    if (entry == json_.end() || !entry->is_object()) fail("the entry is missing", key);
    const auto unit = entry->find("unit");
    if (unit == entry->end() || *unit != "mm") fail("the unit is not \"mm\"", key);
    const auto range = entry->find("range");
    if (range == entry->end() || !range->is_array() || range->size() != 2)
      fail("the range is not two numbers", key);
    const Spread s{value(*entry, "mean", key), value(*entry, "sd", key),
                   millimetres((*range)[0], key), millimetres((*range)[1], key)};
    if (!(s.low <= s.mean && s.mean <= s.high && s.sd >= 0))
      fail("mean, sd and range contradict each other", key);
    return s;
  }

 private:
  [[noreturn]] void fail(const std::string& what, const std::string& key) const {
    throw Error(what, key.empty() ? file_ : file_ + ", \"" + key + "\"",
                "Compare with assets/patients/reference.json");
  }
  double millimetres(const nlohmann::json& number, const char* key) const {
    if (!number.is_number()) fail("a value is not a number", key);
    return 1e-3 * number.get<double>();
  }
  double value(const nlohmann::json& entry, const char* field, const char* key) const {
    if (!entry.contains(field)) fail(std::string("\"") + field + "\" is missing", key);
    return millimetres(entry[field], key);
  }

  std::string file_;
  nlohmann::json json_;
};

// Normal within the range: drawn again outside it, so that the shape inside stays normal.
double draw(const Spread& s, RandomStream* random) {
  for (int i = 0; i < 1000; ++i) {
    const double x = s.mean + s.sd * random->normal();
    if (x >= s.low && x <= s.high) return x;
  }
  return s.mean;
}

}  // namespace

PatientParameters drawParameters(const std::string& reference_json, Side side, std::uint64_t seed) {
  const Reference reference(reference_json);
  PatientParameters p;
  p.side = side;
  p.seed = seed;
  const std::pair<const char*, double*> fields[] = {{"vein_depth", &p.vein_depth},
                                                    {"vein_diameter", &p.vein_diameter},
                                                    {"pleura_distance", &p.pleura_distance},
                                                    {"clavicle_length", &p.clavicle_length},
                                                    {"clavicle_thickness", &p.clavicle_thickness},
                                                    {"skin_thickness", &p.layers.skin},
                                                    {"fat_thickness", &p.layers.fat},
                                                    {"muscle_thickness", &p.layers.muscle}};
  for (const auto& [key, field] : fields) *field = reference.spread(key).mean;
  if (seed == 0) return p;

  RandomStream random(seed);
  std::string last;
  for (int tries = 0; tries < kMostTries; ++tries) {
    for (const auto& [key, field] : fields) *field = draw(reference.spread(key), &random);
    try {
      solve(p);
      return p;
    } catch (const Error& error) {
      last = error.what();
    }
  }
  throw Error("seed " + std::to_string(seed) + " gave no patient in " + std::to_string(kMostTries) +
                  " draws; the last: " + last,
              reference_json, "Narrow the ranges");
}

}  // namespace palpa::anatomy
