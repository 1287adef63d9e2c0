#include "apps/twin/phantom/layered_phantom.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "anatomy/base/file_schema.h"
#include "anatomy/base/json_file.h"
#include "anatomy/base/units.h"
#include "anatomy/base/whole_file.h"
#include "apps/twin/phantom/phantom_file.h"

namespace palpa::twin {
namespace {

/// A cell's force over depth^1.5; below y = 0 the mirror image. Toward no depth at all it goes on
/// straight, as it does between the first two: no contact has a kink.
Vec3 scaledForce(const SurfaceTable& table, int x, int y, int depth) {
  if (depth < 1)
    return (2 - depth) * scaledForce(table, x, y, 1) - (1 - depth) * scaledForce(table, x, y, 2);
  const int i = std::clamp(x, -table.sides, table.sides) + table.sides,
            j = std::min(std::abs(y), table.sides), d = std::min(depth, table.depths);
  const int columns = 2 * table.sides + 1;
  const Vec3 f = table.cells[static_cast<std::size_t>((j * columns + i) * table.depths + d - 1)];
  return Vec3(f.x(), y < 0 ? -f.y() : f.y(), f.z()) / std::pow(d * table.depth_step, 1.5);
}

/// Where a figure lies between two cells.
struct Between {
  int cell = 0;
  std::array<double, 4> weights{};
  Between(double at, double low, double high) {
    const double inside = std::clamp(at, low, high);
    cell = static_cast<int>(std::floor(inside));
    weights = cubicWeights(inside - cell);
  }
};

}  // namespace

Vec3 SurfaceTable::at(const Eigen::Vector2d& p, double depth) const {
  if (!(depth > 0)) return Vec3::Zero();
  const double last = sides;
  const Between x(p.x() / step, -last, last), y(p.y() / step, -last, last),
      d(depth / depth_step, 0, depths);
  Vec3 sum = Vec3::Zero();
  for (int i = 0; i < 4; ++i)
    for (int j = 0; j < 4; ++j)
      for (int k = 0; k < 4; ++k)
        sum += x.weights[static_cast<std::size_t>(i)] * y.weights[static_cast<std::size_t>(j)] *
               d.weights[static_cast<std::size_t>(k)] *
               scaledForce(*this, x.cell + i - 1, y.cell + j - 1, d.cell + k - 1);
  return std::pow(depth, 1.5) * sum;
}

SurfaceTable tabulate(const SoftBlock& block, SurfaceTable shape, const Fineness& fineness,
                      const Tabulated& progress) {
  shape.cells.clear();
  const int all = (shape.sides + 1) * (2 * shape.sides + 1) * shape.depths;
  for (int j = 0; j <= shape.sides; ++j) {
    for (int i = -shape.sides; i <= shape.sides; ++i) {
      const Eigen::Vector2d p(i * shape.step, j * shape.step);
      FiniteBlock solid = FiniteBlock::whole(block, p, shape.tool_radius, fineness);
      for (int d = 1; d <= shape.depths; ++d) {
        shape.cells.push_back(solid.press({Vec3(p.x(), p.y(), -d * shape.depth_step)}).f[0]);
        if (progress) progress(static_cast<int>(shape.cells.size()), all);
      }
    }
  }
  return shape;
}

double RubbingSides::at(double x) const {
  return left + (right - left) / (1 + std::exp(-x / across));
}

PhantomTouch LayeredPhantomTwin::step(const Vec3& tip, double dt) {
  const Vec3 elastic = phantom_.table.at(tip.head<2>(), -tip.z());
  return contact_.step(elastic, tip, dt, phantom_.rubs.at(tip.x()));
}

namespace {

constexpr double kWholeMicronewton = 1e-6;

std::vector<SoftBlock::Layer> layersOf(const JsonFile& phantom) {
  std::vector<SoftBlock::Layer> layers;
  if (!phantom.has("layers")) return layers;
  for (const JsonFile& one : phantom.entries("layers"))
    layers.push_back({kMm * one.number("thickness_mm", 0.2, 100),
                      one.has("slope_mm_per_mm") ? one.number("slope_mm_per_mm", -1, 1) : 0.0,
                      1e3 * one.number("shear_kPa", 0.2, 1000)});
  return layers;
}

std::vector<SoftBlock::Rib> ribsOf(const JsonFile& phantom) {
  std::vector<SoftBlock::Rib> ribs;
  if (!phantom.has("ribs")) return ribs;
  for (const JsonFile& one : phantom.entries("ribs"))
    ribs.push_back({kMm * one.number("x_mm", -100, 100), -kMm * one.number("depth_mm", 3, 100),
                    0.5 * kMm * one.number("diameter_mm", 2, 40),
                    1e3 * one.number("shear_kPa", 0.2, 1000)});
  return ribs;
}

SoftBlock::Lump coreOf(const JsonFile& phantom) {
  return {{kMm * phantom.number("core/x_mm", -100, 100), 0,
           -kMm * phantom.number("core/depth_mm", 3, 100)},
          0.5 * kMm * phantom.number("core/diameter_mm", 4, 40),
          1e3 * phantom.number("core/shear_kPa", 0.2, 1000)};
}

LayeredPhantom phantomOf(const JsonFile& one, SoftBlock block, const SurfaceTable& shape) {
  LayeredPhantom phantom{one.text("name"), std::move(block), {}, shape};
  phantom.block.shear = 1e3 * one.number("shear_kPa", 0.2, 1000);
  phantom.block.layers = layersOf(one);
  phantom.block.ribs = ribsOf(one);
  if (one.has("core")) phantom.block.lump = coreOf(one);
  if (one.has("friction"))
    phantom.rubs = {one.number("friction/left", 0.1, 10), one.number("friction/right", 0.1, 10),
                    kMm * one.number("friction/across_mm", 1, 100)};
  return phantom;
}

}  // namespace

bool isLayered(const std::filesystem::path& name) { return JsonFile(name).has("table/sides"); }

LayeredFile readLayered(const std::filesystem::path& name) {
  const JsonFile file(name);
  needKind(file, "layered_phantoms", 1);
  SoftBlock block;
  block.length = kMm * file.number("block/length_mm", 20, 400);
  block.width = kMm * file.number("block/width_mm", 20, 400);
  block.height = kMm * file.number("block/height_mm", 10, 200);
  block.bulk_over_shear = file.number("block/bulk_over_shear", 5, 500);
  SurfaceTable shape;
  shape.tool_radius = kMm * file.number("tool_radius_mm", 1, 20);
  shape.step = kMm * file.number("table/step_mm", 1, 20);
  shape.depth_step = kMm * file.number("table/depth_step_mm", 0.2, 5);
  shape.sides = file.integer("table/sides", 2, 20);
  shape.depths = file.integer("table/depths", 2, 40);
  LayeredFile all;
  all.fineness.finest = kMm * file.number("table/finest_mm", 0.5, 10);
  all.fineness.growth = file.number("table/growth", 0.1, 2);
  all.fineness.coarsest = kMm * file.number("table/coarsest_mm", 1, 50);
  if (shape.reach() + shape.tool_radius > std::min(block.length, block.width) / 2)
    file.refuse("table/sides", "leads the tool off the block");
  for (const JsonFile& one : file.entries("phantoms"))
    all.phantoms.push_back(phantomOf(one, block, shape));
  if (all.phantoms.empty()) file.refuse("phantoms", "must be a list of phantoms");
  return all;
}

void solveLayered(const std::filesystem::path& name, const std::filesystem::path& out,
                  const std::function<void(const std::string& name, int done, int of)>& progress) {
  const LayeredFile file = readLayered(name);
  WholeFile whole(out);  // before an hour of work
  nlohmann::json tables = nlohmann::json::array();
  for (const LayeredPhantom& phantom : file.phantoms) {
    const SurfaceTable table =
        tabulate(phantom.block, phantom.table, file.fineness, [&](int done, int of) {
          if (progress) progress(phantom.name, done, of);
        });
    nlohmann::json cells = nlohmann::json::array();
    for (const Vec3& f : table.cells)
      for (const double part : {f.x(), f.y(), f.z()})
        cells.push_back(std::lround(part / kWholeMicronewton));
    tables.push_back({{"name", phantom.name}, {"cells", cells}});
  }
  const nlohmann::json all{{"version", 1},
                           {"made_of", JsonFile(name).json()},
                           {"columns", {"f_x_uN", "f_y_uN", "f_up_uN"}},
                           {"tables", tables}};
  whole.write(all.dump() + '\n');
  whole.finish();
}

std::vector<LayeredPhantom> readSolvedLayered(const std::filesystem::path& name,
                                              const std::filesystem::path& tables_name) {
  LayeredFile file = readLayered(name);
  const JsonFile tables(tables_name);
  needKind(tables, "layered_tables", 1);
  needMadeOf(tables, name);
  const std::vector<JsonFile> each = tables.entries("tables");
  if (each.size() != file.phantoms.size()) tables.refuse("tables", "must be one for each phantom");
  for (std::size_t i = 0; i < file.phantoms.size(); ++i) {
    SurfaceTable& table = file.phantoms[i].table;
    if (each[i].text("name") != file.phantoms[i].name)
      each[i].refuse("name", "must be \"" + file.phantoms[i].name + "\"");
    const std::vector<double> figures = each[i].numbers("cells");
    const auto cells =
        static_cast<std::size_t>((table.sides + 1) * (2 * table.sides + 1) * table.depths);
    if (figures.size() != 3 * cells) each[i].refuse("cells", "has not the right number of figures");
    for (std::size_t c = 0; c < cells; ++c)
      table.cells.push_back(kWholeMicronewton *
                            Vec3(figures[3 * c], figures[3 * c + 1], figures[3 * c + 2]));
  }
  return file.phantoms;
}

}  // namespace palpa::twin
