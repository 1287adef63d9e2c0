#include "apps/twin/phantom/opposed_phantom.h"

#include <cmath>

#include "anatomy/base/file_schema.h"
#include "anatomy/base/json_file.h"
#include "anatomy/base/units.h"
#include "anatomy/base/whole_file.h"
#include "apps/twin/phantom/phantom_file.h"

namespace palpa::twin {
namespace {

constexpr double kUnitForce = 1e-6, kUnitWay = 1e-6;  // N, m: whole figures of a file
constexpr double kFeltAcross = 0.022;                 // m

Vec3 upsideDown(const Vec3& v) { return {v.x(), v.y(), -v.z()}; }

}  // namespace

std::array<PhantomTouch, 2> OpposedPhantomTwin::step(const std::array<Vec3, 2>& tips, double dt) {
  const std::array<Vec3, 2> from_above{tips[0], mirroredInSlab(tips[1], table_.thickness)};
  const double beside = (tips[0] - tips[1]).head<2>().norm() / kFeltAcross,
               share = 1 / (1 + beside * beside);
  std::array<PhantomTouch, 2> touches;
  for (std::size_t t = 0; t < 2; ++t) {
    const double away = tips[t].head<2>().norm();
    const Vec3 out =
        away > 0 ? Vec3(tips[t].x() / away, tips[t].y() / away, 0) : Vec3(Vec3::UnitX());
    const OpposedCell cell = table_.at(away, {-from_above[0].z(), -from_above[1].z()}, share);
    const Vec3 elastic = cell.f[t].x() * out + cell.f[t].y() * Vec3::UnitZ();
    PhantomTouch touch = contacts_[t].step(elastic, from_above[t], dt);
    if (t == 1) {
      touch.f = upsideDown(touch.f);
      touch.n = upsideDown(touch.n);
    }
    touch.lump = cell.lump.x() * out + cell.lump.y() * Vec3::UnitZ();
    touches[t] = touch;
  }
  return touches;
}

namespace {

SoftBlock::Lump middleLump(const JsonFile& phantom, const SoftBlock& block) {
  SoftBlock::Lump lump;
  lump.radius = 0.5 * kMm * phantom.number("lump/diameter_mm", 4, 40);
  lump.centre = {0, 0, -0.5 * block.height};
  lump.shear = block.shear * phantom.number("lump/times_stiffer", 0.1, 100);
  if (2 * lump.radius > 0.8 * block.height)
    phantom.refuse("lump/diameter_mm", "leaves too little of the slab above and below it");
  return lump;
}

nlohmann::json cellsOf(const OpposedTable& table) {
  nlohmann::json cells = nlohmann::json::array();
  for (const OpposedCell& c : table.cells)
    cells.push_back({std::lround(c.f[0].x() / kUnitForce), std::lround(c.f[0].y() / kUnitForce),
                     std::lround(c.f[1].x() / kUnitForce), std::lround(c.f[1].y() / kUnitForce),
                     std::lround(c.lump.x() / kUnitWay), std::lround(c.lump.y() / kUnitWay)});
  return cells;
}

/// A list of so many whole numbers that stands at `at` in the tables.
std::vector<double> wholeNumbers(const JsonFile& tables, const nlohmann::json& list,
                                 const std::string& at, std::size_t count) {
  if (!list.is_array() || list.size() != count)
    tables.refuse(at, "must be " + std::to_string(count) + " whole numbers");
  std::vector<double> all;
  for (const nlohmann::json& one : list) {
    if (!one.is_number_integer())
      tables.refuse(at, "must be " + std::to_string(count) + " whole numbers");
    all.push_back(static_cast<double>(one.get<std::int64_t>()));
  }
  return all;
}

void readTable(const JsonFile& tables, std::size_t phantom, OpposedTable* table) {
  constexpr std::size_t kFigures = 6;
  const std::string number = std::to_string(phantom);
  const nlohmann::json& cells = tables.json()["tables"][phantom];
  const auto depths = static_cast<std::size_t>(table->depths),
             aways = static_cast<std::size_t>(table->aways), each = depths * (depths + 3) / 2;
  if (!cells.is_array() || cells.size() != aways * each)
    tables.refuse("tables/" + number, "has not the right number of cells");
  for (const double um :
       wholeNumbers(tables, tables.json()["under"][phantom], "under/" + number, aways * depths))
    table->under.push_back(um * kUnitWay);
  for (std::size_t i = 0; i < cells.size(); ++i) {
    const std::vector<double> c =
        wholeNumbers(tables, cells[i], "tables/" + number + "/" + std::to_string(i), kFigures);
    table->cells.push_back(
        {{Eigen::Vector2d(c[0], c[1]) * kUnitForce, Eigen::Vector2d(c[2], c[3]) * kUnitForce},
         Eigen::Vector2d(c[4], c[5]) * kUnitWay});
  }
}

}  // namespace

bool isOpposed(const std::filesystem::path& name) {
  return JsonFile(name).has("block/thickness_mm");
}

OpposedFile readOpposed(const std::filesystem::path& name) {
  const JsonFile file(name);
  needKind(file, "opposed_phantoms", 1);
  SoftBlock block;
  block.framed = true;
  block.length = kMm * file.number("block/length_mm", 20, 400);
  block.width = kMm * file.number("block/width_mm", 20, 400);
  block.height = kMm * file.number("block/thickness_mm", 10, 200);
  block.shear = 1e3 * file.number("block/shear_kPa", 0.2, 100);
  block.bulk_over_shear = file.number("block/bulk_over_shear", 5, 500);
  OpposedTable shape;
  shape.tool_radius = kMm * file.number("tool_radius_mm", 1, 20);
  shape.thickness = block.height;
  shape.away_step = kMm * file.number("table/away_step_mm", 0.5, 20);
  shape.depth_step = kMm * file.number("table/depth_step_mm", 0.2, 5);
  shape.aways = file.integer("table/aways", 1, 40);
  shape.depths = file.integer("table/depths", 2, 20);
  OpposedFile all;
  all.fineness.finest = kMm * file.number("table/finest_mm", 0.5, 10);
  all.fineness.growth = file.number("table/growth", 0.1, 2);
  if ((shape.aways - 1) * shape.away_step + shape.tool_radius > block.length / 2)
    file.refuse("table/aways", "leads the tool into the frame");
  if (2 * shape.depths * shape.depth_step > 0.7 * block.height)
    file.refuse("table/depths", "leaves nothing of the slab between the tools");
  for (const JsonFile& one : file.entries("phantoms")) {
    OpposedPhantom phantom{one.text("name"), block, shape};
    if (one.has("lump")) phantom.block.lump = middleLump(one, block);
    all.phantoms.push_back(phantom);
  }
  if (all.phantoms.empty()) file.refuse("phantoms", "must be a list of phantoms");
  return all;
}

void solveOpposed(const std::filesystem::path& name, const std::filesystem::path& out,
                  const std::function<void(const std::string& name, int done, int of)>& progress) {
  const OpposedFile file = readOpposed(name);
  WholeFile whole(out);  // before minutes of work
  nlohmann::json tables = nlohmann::json::array(), under = nlohmann::json::array();
  for (const OpposedPhantom& phantom : file.phantoms) {
    const OpposedTable table =
        tabulateOpposed(phantom.block, phantom.table, file.fineness, [&](int done, int of) {
          if (progress) progress(phantom.name, done, of);
        });
    tables.push_back(cellsOf(table));
    nlohmann::json& ways = under.emplace_back(nlohmann::json::array());
    for (const double way : table.under) ways.push_back(std::lround(way / kUnitWay));
  }
  const nlohmann::json all{{"version", 1},
                           {"made_of", JsonFile(name).json()},
                           {"columns",
                            {"f_first_out_uN", "f_first_off_uN", "f_second_out_uN",
                             "f_second_off_uN", "lump_out_um", "lump_up_um"}},
                           {"tables", tables},
                           {"under", under}};
  whole.write(all.dump() + '\n');
  whole.finish();
}

std::vector<OpposedPhantom> readSolvedOpposed(const std::filesystem::path& name,
                                              const std::filesystem::path& tables_name) {
  OpposedFile file = readOpposed(name);
  const JsonFile tables(tables_name);
  needKind(tables, "opposed_tables", 1);
  needMadeOf(tables, name);
  for (const char* list : {"tables", "under"})
    if (!tables.has(list) || !tables.json()[list].is_array() ||
        tables.json()[list].size() != file.phantoms.size())
      tables.refuse(list, "must be one for each phantom");
  for (std::size_t i = 0; i < file.phantoms.size(); ++i)
    readTable(tables, i, &file.phantoms[i].table);
  return file.phantoms;
}

}  // namespace palpa::twin
