#include "apps/twin/phantom/phantom_file.h"

#include <algorithm>
#include <cmath>
#include <fstream>

#include "anatomy/geometry/error.h"
#include "apps/station/json_file.h"

namespace palpa::twin {
namespace {

constexpr double kMm = 1e-3, kMicrometre = 1e-6, kMicronewton = 1e-6;

SoftBlock::Lump lumpOf(const station::JsonFile& phantom, const SoftBlock& block) {
  SoftBlock::Lump lump;
  lump.radius = 0.5 * kMm * phantom.number("lump/diameter_mm", 4, 40);
  lump.centre = {0, 0, -kMm * phantom.number("lump/depth_mm", 3, 100)};
  lump.shear = block.shear * phantom.number("lump/times_stiffer", 0.1, 100);
  if (-lump.centre.z() < lump.radius || -lump.centre.z() + lump.radius > block.height) phantom.refuse("lump", "lies outside the block");
  return lump;
}

/// Whole micrometres and micronewtons: below what the elements are true to.
nlohmann::json written(const PhantomTable& table) {
  nlohmann::json cells = nlohmann::json::array();
  for (const PhantomTable::Cell& c : table.cells)
    cells.push_back({std::lround(c.f_out / kMicronewton), std::lround(c.f_up / kMicronewton), std::lround(c.lump_out / kMicrometre), std::lround(c.lump_up / kMicrometre)});
  return cells;
}

}  // namespace

PhantomFile readPhantoms(const std::filesystem::path& name) {
  const station::JsonFile file(name);
  file.needVersion(1);
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
  if (all.shape.aways * all.shape.away_step + all.shape.tool_radius > block.length / 2) file.refuse("table/aways", "leads the tool off the block");
  if (!file.has("phantoms") || !file.json()["phantoms"].is_array() || file.json()["phantoms"].empty()) file.refuse("phantoms", "must be a list of phantoms");
  for (std::size_t i = 0; i < file.json()["phantoms"].size(); ++i) {
    const station::JsonFile one(file.json()["phantoms"][i], file.name() + ", phantom " + std::to_string(i + 1));
    Phantom phantom{one.text("name"), block, all.shape};
    if (one.has("lump")) phantom.block.lump = lumpOf(one, block);
    all.phantoms.push_back(phantom);
  }
  return all;
}

void solvePhantoms(const std::filesystem::path& name, const std::filesystem::path& out, const std::function<void(const std::string& name, int done, int of)>& progress) {
  const PhantomFile file = readPhantoms(name);
  nlohmann::json tables = nlohmann::json::array();
  for (const Phantom& phantom : file.phantoms) {
    tables.push_back(written(tabulate(phantom.block, phantom.table, file.fineness, [&](int done, int of) {
      if (progress) progress(phantom.name, done, of);
    })));
  }
  const nlohmann::json all{{"version", 1}, {"made_of", station::JsonFile(name).json()}, {"columns", {"f_out_uN", "f_up_uN", "lump_out_um", "lump_up_um"}}, {"tables", tables}};
  std::filesystem::path part = out;
  part += ".part";
  {
    std::ofstream stream(part);
    stream << all.dump() << '\n';
    if (!stream.flush()) throw Error("cannot be written", out.string(), "Check the folder and the space on its disk");
  }
  std::filesystem::rename(part, out);
}

std::vector<Phantom> readSolved(const std::filesystem::path& name, const std::filesystem::path& tables_name) {
  PhantomFile file = readPhantoms(name);
  const station::JsonFile tables(tables_name);
  tables.needVersion(1);
  if (!tables.has("made_of") || tables.json()["made_of"] != station::JsonFile(name).json()) tables.refuse("made_of", "is not " + name.string() + " (solve it anew: palpa phantom solve)");
  if (!tables.has("tables") || tables.json()["tables"].size() != file.phantoms.size()) tables.refuse("tables", "must be one for each phantom");
  for (std::size_t i = 0; i < file.phantoms.size(); ++i) {
    PhantomTable& table = file.phantoms[i].table;
    const nlohmann::json& cells = tables.json()["tables"][i];
    const std::string at = "tables/" + std::to_string(i);
    if (!cells.is_array() || cells.size() != static_cast<std::size_t>(table.aways) * table.depths) tables.refuse(at, "has not the right number of cells");
    for (std::size_t c = 0; c < cells.size(); ++c) {
      const bool good = cells[c].is_array() && cells[c].size() == 4 && std::all_of(cells[c].begin(), cells[c].end(), [](const auto& v) { return v.is_number_integer(); });
      if (!good) tables.refuse(at + "/" + std::to_string(c), "must be four whole numbers");
      const auto figure = [&](int k, double unit) { return unit * static_cast<double>(cells[c][static_cast<std::size_t>(k)].get<std::int64_t>()); };
      table.cells.push_back({figure(0, kMicronewton), figure(1, kMicronewton), figure(2, kMicrometre), figure(3, kMicrometre)});
    }
  }
  return file.phantoms;
}

}  // namespace palpa::twin
