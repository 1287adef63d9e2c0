#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <string>

#include "anatomy/base/error.h"
#include "anatomy/base/pinned_math.h"
#include "apps/station/calibration_file.h"
#include "apps/station/material_files.h"

namespace palpa::station {
namespace {

constexpr double kPeaks = 3;            // of the rms: 0.3 % of a normal noise lies beyond
constexpr double kEdge = 0.999999;      // a reflection coefficient is below 1
constexpr double kRateWithin_Hz = 0.5;  // of 1 kHz

const std::vector<double>& figuresOf(const CalibrationFile& file, const std::string& name) {
  for (const CalibrationFile::Numbers& numbers : file.parameters)
    if (numbers.name == name) return numbers.values;
  static const std::vector<double> none;
  return none;
}

/// Logarithms of a rising row of figures above 0; how many.
template <std::size_t N>
std::uint32_t readRow(const std::vector<double>& figures, const std::string& path, const char* name,
                      std::array<double, N>* ln_row) {
  bool good = !figures.empty() && figures.size() <= N;
  for (std::size_t i = 0; good && i < figures.size(); ++i) {
    good = figures[i] > 0 && (i == 0 || figures[i] > figures[i - 1]);
    (*ln_row)[i] = pinned::log(figures[i]);
  }
  if (!good)
    throw Error(
        std::string("has ") + name + " that are not 1 to " + std::to_string(N) + " rising figures",
        path, "Identify it again: palpa calibrate texture");
  return static_cast<std::uint32_t>(figures.size());
}

haptics::TextureNode nodeOf(double rms, const double* reflection, std::uint32_t order,
                            const std::string& path) {
  haptics::TextureNode node;
  bool good = rms > 0;
  node.ln_rms = good ? pinned::log(rms) : 0;
  for (std::size_t i = 0; i < order; ++i) {
    node.reflection[i] = reflection[i];
    good = good && std::abs(reflection[i]) <= kEdge;
  }
  if (!good)
    throw Error(
        "has a level that is not above 0, or a reflection coefficient that is not within "
        "-1 to 1",
        path, "Identify it again: palpa calibrate texture");
  return node;
}

}  // namespace

haptics::TextureLaw readTexture(const std::filesystem::path& name) {
  const CalibrationFile file = readCalibration(name);
  const std::string path = name.string();
  if (file.kind != CalibrationKind::texture)
    throw Error("is a calibration of \"" + nameOf(file.kind) + "\", not of \"texture\"", path,
                "Name one of assets/materials/textures");
  if (!file.passed())
    throw Error("did not pass: " + file.verdict, path,
                "Identify it again: palpa calibrate texture");
  haptics::TextureLaw law;
  law.largest = std::numeric_limits<double>::infinity();
  law.forces = readRow(figuresOf(file, "forces_N"), path, "forces_N", &law.ln_force);
  law.speeds = readRow(figuresOf(file, "speeds_m_per_s"), path, "speeds_m_per_s", &law.ln_speed);
  const double order = file.at("order", 1)[0];
  if (!(order >= 1 && order <= haptics::kMostTextureOrder) || order != std::floor(order))
    throw Error("has an order that is not 1 to " + std::to_string(haptics::kMostTextureOrder), path,
                "Identify it again: palpa calibrate texture");
  law.order = static_cast<std::uint32_t>(order);
  const std::size_t nodes = std::size_t{law.forces} * law.speeds;
  const std::vector<double>&rms = file.at("leaky_sum_rms_N", nodes),
        &reflection = file.at("reflection", nodes * law.order);
  for (std::size_t n = 0; n < nodes; ++n)
    law.nodes[n / law.speeds][n % law.speeds] =
        nodeOf(rms[n], &reflection[n * law.order], law.order, path);
  return law;
}

haptics::TextureLaw bounded(haptics::TextureLaw texture, double slew_N_per_s, double rate_Hz) {
  if (texture.speeds == 0) return texture;
  if (std::abs(rate_Hz * haptics::kTexturePeriod - 1) > kRateWithin_Hz * haptics::kTexturePeriod)
    throw UsageError("cannot be rendered at " + std::to_string(std::lround(rate_Hz)) + " Hz",
                     "the surface's texture", "Take --rate 1000, or a library without a texture");
  texture.largest = haptics::largestTexture(slew_N_per_s);
  double strongest = 0;
  for (std::size_t f = 0; f < texture.forces; ++f)
    for (std::size_t v = 0; v < texture.speeds; ++v)
      strongest = std::max(strongest, haptics::textureRms(texture.nodes[f][v]));
  if (kPeaks * strongest > texture.largest)
    throw UsageError("has up to " + std::to_string(strongest) +
                         " N rms; with this station's limit "
                         "of rise at most " +
                         std::to_string(texture.largest / kPeaks) + " N pass",
                     "the surface's texture", "Take a weaker texture");
  return texture;
}

}  // namespace palpa::station
