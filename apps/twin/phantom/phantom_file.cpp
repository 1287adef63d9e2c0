#include "apps/twin/phantom/phantom_file.h"

#include <algorithm>
#include <cmath>

#include "anatomy/base/file_schema.h"
#include "anatomy/base/json_file.h"
#include "anatomy/base/units.h"
#include "anatomy/base/whole_file.h"

namespace palpa::twin {
namespace {

constexpr double kMicrometre = 1e-6, kMicronewton = 1e-6;

SoftBlock::Lump lumpOf(const JsonFile& phantom, const SoftBlock& block) {
  SoftBlock::Lump lump;
  lump.radius = 0.5 * kMm * phantom.number("lump/diameter_mm", 4, 40);
  lump.centre = {0, 0, -kMm * phantom.number("lump/depth_mm", 3, 100)};
  lump.shear = block.shear * phantom.number("lump/times_stiffer", 0.1, 100);
  if (-lump.centre.z() < lump.radius || -lump.centre.z() + lump.radius > block.height)
    phantom.refuse("lump", "lies outside the block");
  return lump;
}

/// Whole micrometres and micronewtons: below what the elements are true to.
nlohmann::json written(const PhantomTable& table) {
  nlohmann::json cells = nlohmann::json::array();
  for (const PhantomCell& c : table.cells)
    cells.push_back({std::lround(c.f_out / kMicronewton), std::lround(c.f_up / kMicronewton),
                     std::lround(c.lump_out / kMicrometre), std::lround(c.lump_up / kMicrometre)});
  return cells;
}
nlohmann::json written(const PairTable& table) {
  nlohmann::json cells = nlohmann::json::array();
  for (const PairCell& c : table.cells) {
    cells.push_back(nlohmann::json::array());
    for (const double f : {c.f[0].x(), c.f[0].y(), c.f[1].x(), c.f[1].y()})
      cells.back().push_back(std::lround(f / kMicronewton));
    for (const double d : {c.lump.x(), c.lump.y()})
      cells.back().push_back(std::lround(d / kMicrometre));
  }
  return cells;
}

/// The cells of one phantom, each of the same number of whole figures.
std::vector<std::vector<double>> readCells(const JsonFile& tables, const char* list,
                                           std::size_t phantom, std::size_t count,
                                           std::size_t figures) {
  const nlohmann::json& cells = tables.json()[list][phantom];
  const std::string at = std::string(list) + "/" + std::to_string(phantom);
  if (!cells.is_array() || cells.size() != count)
    tables.refuse(at, "has not the right number of cells");
  std::vector<std::vector<double>> read;
  for (const nlohmann::json& cell : cells) {
    const bool good =
        cell.is_array() && cell.size() == figures &&
        std::all_of(cell.begin(), cell.end(), [](const auto& v) { return v.is_number_integer(); });
    if (!good)
      tables.refuse(at + "/" + std::to_string(read.size()),
                    "must be " + std::to_string(figures) + " whole numbers");
    std::vector<double>& row = read.emplace_back();
    for (const nlohmann::json& figure : cell)
      row.push_back(static_cast<double>(figure.get<std::int64_t>()));
  }
  return read;
}

}  // namespace

PhantomFile readPhantoms(const std::filesystem::path& name) {
  const JsonFile file(name);
  needKind(file, "phantoms", 1);
  PhantomFile all;
  SoftBlock block;
  block.length = kMm * file.number("block/length_mm", 20, 400);
  block.width = kMm * file.number("block/width_mm", 20, 400);
  block.height = kMm * file.number("block/height_mm", 10, 200);
  block.shear = 1e3 * file.number("block/shear_kPa", 0.2, 100);
  block.bulk_over_shear = file.number("block/bulk_over_shear", 5, 500);
  all.shape.tool_radius = kMm * file.number("tool_radius_mm", 1, 20);
  all.shape.away_step = kMm * file.number("table/away_step_mm", 0.5, 20);
  all.shape.depth_step = kMm * file.number("table/depth_step_mm", 0.2, 5);
  all.shape.aways = file.integer("table/aways", 1, 40);
  all.shape.depths = file.integer("table/depths", 2, 40);
  all.fineness.finest = kMm * file.number("table/finest_mm", 0.5, 10);
  all.fineness.growth = file.number("table/growth", 0.1, 2);
  all.both.apart = kMm * file.number("pairs/apart_mm", 2, 100);
  all.both.shift_step = kMm * file.number("pairs/shift_step_mm", 0.5, 20);
  all.both.depth_step = kMm * file.number("pairs/depth_step_mm", 0.2, 5);
  all.both.shifts = file.integer("pairs/shifts", 1, 10);
  all.both.depths = file.integer("pairs/depths", 1, 10);
  if (all.both.apart < 2 * all.shape.tool_radius)
    file.refuse("pairs/apart_mm", "lets the tools overlap");
  if (all.both.shifts * all.both.shift_step + all.both.apart / 2 + all.shape.tool_radius >
      block.length / 2)
    file.refuse("pairs/shifts", "leads a tool off the block");
  if (all.shape.aways * all.shape.away_step + all.shape.tool_radius > block.length / 2)
    file.refuse("table/aways", "leads the tool off the block");
  for (const JsonFile& one : file.entries("phantoms")) {
    Phantom phantom{one.text("name"), block, all.shape, all.both};
    if (one.has("lump")) phantom.block.lump = lumpOf(one, block);
    all.phantoms.push_back(phantom);
  }
  if (all.phantoms.empty()) file.refuse("phantoms", "must be a list of phantoms");
  return all;
}

void solvePhantoms(const std::filesystem::path& name, const std::filesystem::path& out,
                   const std::function<void(const std::string& name, int done, int of)>& progress) {
  const PhantomFile file = readPhantoms(name);
  WholeFile whole(out);  // before minutes of work
  nlohmann::json tables = nlohmann::json::array(), pairs = nlohmann::json::array();
  for (const Phantom& phantom : file.phantoms) {
    const int ones = phantom.table.aways * phantom.table.depths,
              all = ones + phantom.both.shifts * phantom.both.depths * phantom.both.depths;
    const auto report = [&](int done) {
      if (progress) progress(phantom.name, done, all);
    };
    const PhantomTable one =
        tabulate(phantom.block, phantom.table, file.fineness, [&](int done, int) { report(done); });
    tables.push_back(written(one));
    pairs.push_back(written(tabulatePairs(phantom.block, one, phantom.both, file.fineness,
                                          [&](int done, int) { report(ones + done); })));
  }
  const nlohmann::json all{{"version", 1},
                           {"made_of", JsonFile(name).json()},
                           {"columns", {"f_out_uN", "f_up_uN", "lump_out_um", "lump_up_um"}},
                           {"tables", tables},
                           {"pair_columns",
                            {"f_first_x_uN", "f_first_up_uN", "f_second_x_uN", "f_second_up_uN",
                             "lump_x_um", "lump_up_um"}},
                           {"pairs", pairs}};
  whole.write(all.dump() + '\n');
  whole.finish();
}

Phantom SoftSurface::madeOf(Phantom plain) const {
  const double times = shear / plain.block.shear;
  plain.block.shear = shear;
  for (PhantomCell& cell : plain.table.cells) {
    cell.f_out *= times;
    cell.f_up *= times;
  }
  for (PairCell& cell : plain.both.cells)
    for (auto& f : cell.f) f *= times;
  return plain;
}

std::vector<SoftSurface> readSoftSurfaces(const std::filesystem::path& name) {
  const JsonFile file(name);
  needKind(file, "surfaces", 1);
  std::vector<SoftSurface> all;
  for (const JsonFile& one : file.entries("surfaces")) {
    SoftSurface surface;
    surface.name = one.text("name");
    surface.shear = 1e3 * one.number("simulated/shear_kPa", 0.2, 40);
    surface.law.mu = one.number("simulated/friction", 0.02, 2);
    surface.law.sigma = one.number("simulated/before_sliding_N_per_m", 100, 10'000);
    surface.law.B = one.number("simulated/viscous_Ns_per_m", 0, 5);
    all.push_back(std::move(surface));
  }
  if (all.empty()) file.refuse("surfaces", "needs at least one entry");
  return all;
}

void needMadeOf(const JsonFile& tables, const std::filesystem::path& name) {
  if (!tables.has("made_of") || tables.json()["made_of"] != JsonFile(name).json())
    tables.refuse("made_of", "is not " + name.string() + " (solve it again: palpa phantom solve)");
}

std::vector<Phantom> readSolved(const std::filesystem::path& name,
                                const std::filesystem::path& tables_name) {
  PhantomFile file = readPhantoms(name);
  const JsonFile tables(tables_name);
  needKind(tables, "phantom_tables", 1);
  needMadeOf(tables, name);
  for (const char* list : {"tables", "pairs"}) {
    if (!tables.has(list) || !tables.json()[list].is_array() ||
        tables.json()[list].size() != file.phantoms.size())
      tables.refuse(list, "must be one for each phantom");
  }
  for (std::size_t i = 0; i < file.phantoms.size(); ++i) {
    PhantomTable& table = file.phantoms[i].table;
    PairTable& both = file.phantoms[i].both;
    for (const std::vector<double>& c :
         readCells(tables, "tables", i, static_cast<std::size_t>(table.aways) * table.depths, 4))
      table.cells.push_back(
          {c[0] * kMicronewton, c[1] * kMicronewton, c[2] * kMicrometre, c[3] * kMicrometre});
    for (const std::vector<double>& c :
         readCells(tables, "pairs", i,
                   static_cast<std::size_t>(both.shifts) * both.depths * both.depths, 6)) {
      const Eigen::Map<const Eigen::Matrix<double, 6, 1>> v(c.data());
      both.cells.push_back({{v.segment<2>(0) * kMicronewton, v.segment<2>(2) * kMicronewton},
                            v.segment<2>(4) * kMicrometre});
    }
  }
  return file.phantoms;
}

}  // namespace palpa::twin
