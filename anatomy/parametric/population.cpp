#include "anatomy/parametric/population.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "anatomy/base/error.h"
#include "anatomy/base/file_schema.h"
#include "anatomy/base/json_file.h"
#include "anatomy/base/random.h"
#include "anatomy/parametric/build.h"
#include "anatomy/parametric/feasibility.h"
#include "anatomy/parametric/parametric_patient.h"

namespace palpa::anatomy {
namespace {

double correlationIn(const JsonFile& file, const std::string& entry) {
  const double r = file.number(entry + "/r");
  if (!(r > -1 && r < 1)) file.refuse(entry + "/r", "is not between -1 and 1");
  return r;
}

/// `unit`: as the file must state it; `si`: what one of it is.
Spread spreadIn(const JsonFile& file, const std::string& entry, const std::string& unit = "mm",
                double si = 1e-3) {
  if (const std::string stated = file.text(entry + "/unit"); stated != unit)
    file.refuse(entry + "/unit", "is \"" + stated + "\", not \"" + unit + "\"");
  const std::vector<double> range = file.numbers(entry + "/range");
  if (range.size() != 2) file.refuse(entry + "/range", "is not two numbers");
  const Spread s{si * file.number(entry + "/mean"), si * file.number(entry + "/sd"), si * range[0],
                 si * range[1]};
  if (!(s.low <= s.mean && s.mean <= s.high && s.sd >= 0))
    file.refuse(entry, "has a mean, an sd and a range that contradict each other");
  return s;
}

Population populationIn(const JsonFile& file) {
  Population p;
  p.height_women = spreadIn(file, "height_women", "m", 1);
  p.height_men = spreadIn(file, "height_men", "m", 1);
  p.bmi = spreadIn(file, "bmi", "kg/m2", 1);
  p.vein_depth = spreadIn(file, "vein_depth");
  p.vein_diameter = spreadIn(file, "vein_diameter");
  p.pleura_distance = spreadIn(file, "pleura_distance");
  p.clavicle_length = spreadIn(file, "clavicle_length");
  p.clavicle_thickness = spreadIn(file, "clavicle_thickness");
  p.skin_thickness = spreadIn(file, "skin_thickness");
  p.fat_share_women = spreadIn(file, "fat_share_women", "percent", 0.01);
  p.fat_share_men = spreadIn(file, "fat_share_men", "percent", 0.01);
  p.vein_depth_with_bmi = correlationIn(file, "vein_depth_with_bmi");
  p.fat_share_with_bmi = correlationIn(file, "fat_share_with_bmi");
  p.clavicle_length_with_height = correlationIn(file, "clavicle_length_with_height");
  return p;
}

}  // namespace

Population readPopulation(const std::string& reference_json) {
  const JsonFile file = readOwnFile([&] {
    return JsonFile(std::filesystem::path(reference_json),
                    "Compare with assets/patients/reference.json");
  });
  refuseUnknownFields(file, "population");
  return readOwnFile([&] { return populationIn(file); });
}

namespace {

constexpr int kMostTries = 200;

// Normal deviate; 0 for the means.
class Dice {
 public:
  explicit Dice(std::uint64_t seed) : still_(seed == 0), random_(RandomStream::ofSeed(seed)) {}
  double normal() { return still_ ? 0 : random_.openNormal(); }
  bool still() const { return still_; }
  bool heads() { return !still_ && random_.openUniform() < 0.5; }

 private:
  bool still_;
  RandomStream random_;
};

// The spread before the ends are cut off at which the one that is left is the published one
// (moments of the truncated normal; a range of a few spreads to either side).
double uncut(const Spread& s) {
  if (s.sd <= 0) return 0;
  double sd = s.sd;
  for (int i = 0; i < 30; ++i) {
    const double a = (s.low - s.mean) / sd, b = (s.high - s.mean) / sd;
    const auto density = [](double x) {
      return std::exp(-0.5 * x * x) / std::sqrt(2 * std::numbers::pi);
    };
    const double inside =
        0.5 * (std::erf(b / std::numbers::sqrt2) - std::erf(a / std::numbers::sqrt2));
    const double shift = (density(a) - density(b)) / inside;
    const double left =
        sd * std::sqrt(1 + (a * density(a) - b * density(b)) / inside - shift * shift);
    sd *= std::min(s.sd / left, 1.1);
    if (sd > 1.5 * s.sd) return 1.5 * s.sd;  // too narrow a range for such a spread
  }
  return sd;
}

// Normal within the range: drawn again outside it, so that the shape inside stays normal. `known`:
// how many deviations a quantity that goes together with this one (correlation r) is off its mean.
double draw(const Spread& s, Dice* dice, double r = 0, double known = 0) {
  double x = s.mean;
  const double sd = uncut(s);
  for (int i = 0; i < 1000; ++i) {
    x = s.mean + sd * (r * known + std::sqrt(1 - r * r) * dice->normal());
    if (x >= s.low && x <= s.high) return x;
  }
  return std::clamp(x, s.low, s.high);
}

double stated(double value, const Spread& s, const char* what, const char* unit) {
  if (value >= s.low && value <= s.high) return value;
  throw Error(std::string(what) + " is " + std::to_string(value) + " " + unit + ", outside " +
                  std::to_string(s.low) + " to " + std::to_string(s.high) + " " + unit,
              "parametric patient", "Give a value inside the range");
}

// Height and body mass index with how many deviations of the whole population they are off its
// means.
struct Body {
  Sex sex;
  double height, bmi, taller, heavier;
};

Body drawBody(const Population& population, const Person& person, Dice* dice) {
  const Spread &women = population.height_women, &men = population.height_men,
               &bmi = population.bmi;
  // Of women and men in equal numbers.
  const double mean = (women.mean + men.mean) / 2, apart = (men.mean - women.mean) / 2;
  const double sd = std::sqrt((women.sd * women.sd + men.sd * men.sd) / 2 + apart * apart);
  Body body;
  const bool female = dice->heads();
  body.sex = person.sex.value_or(female ? Sex::female : Sex::male);
  const Spread& height = body.sex == Sex::female ? women : men;
  const double drawn_height = draw(height, dice), drawn_bmi = draw(bmi, dice);
  body.height = person.height ? stated(*person.height, height, "height", "m") : drawn_height;
  if (dice->still() && !person.sex && !person.height) body.height = mean;
  body.bmi = person.bmi ? stated(*person.bmi, bmi, "bmi", "kg/m2") : drawn_bmi;
  body.taller = (body.height - mean) / sd;
  body.heavier = (body.bmi - bmi.mean) / bmi.sd;
  return body;
}

SoftLayers layersFor(const Population& population, double vein_depth, const Body& body,
                     Dice* dice) {
  const double all = 1e-3 * softAtEntry(softAtWindow(1e3 * vein_depth));
  SoftLayers layers;
  layers.skin = draw(population.skin_thickness, dice);
  const Spread& share =
      body.sex == Sex::male ? population.fat_share_men : population.fat_share_women;
  layers.fat = draw(share, dice, population.fat_share_with_bmi, body.heavier) * (all - layers.skin);
  layers.muscle = all - layers.skin - layers.fat;
  return layers;
}

}  // namespace

PatientParameters drawParameters(const Population& population, Side side, std::uint64_t seed,
                                 const Person& person) {
  Dice dice(seed);
  std::string last;
  for (int tries = 0; tries < (seed == 0 ? 1 : kMostTries); ++tries) {
    const Body body = drawBody(population, person, &dice);
    PatientParameters p;
    p.side = side;
    p.seed = seed;
    p.sex = body.sex;
    p.height = body.height;
    p.bmi = body.bmi;
    p.vein_depth = draw(population.vein_depth, &dice, population.vein_depth_with_bmi, body.heavier);
    p.vein_diameter = draw(population.vein_diameter, &dice);
    p.pleura_distance = draw(population.pleura_distance, &dice);
    p.clavicle_length = draw(population.clavicle_length, &dice,
                             population.clavicle_length_with_height, body.taller);
    p.clavicle_thickness = draw(population.clavicle_thickness, &dice);
    p.layers = layersFor(population, p.vein_depth, body, &dice);
    try {
      solve(p);
      return p;
    } catch (const Error& error) {
      last = error.what();
    }
  }
  throw Error("seed " + std::to_string(seed) + " gave no patient in " + std::to_string(kMostTries) +
                  " draws; the last: " + last,
              "population", "Narrow the ranges");
}

}  // namespace palpa::anatomy
