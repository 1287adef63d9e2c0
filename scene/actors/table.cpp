#include "scene/actors/table.h"

#include <algorithm>
#include <cmath>

#include "scene/palette.h"

namespace palpa::scene {
namespace {

constexpr int kTexels = 192;
constexpr double kTouches = 0.006, kTouchBlur = 0.005;  // m: so high above the table it touches
constexpr float kTouchDark = 0.45F, kOutlineDark = 0.42F;

struct Square {
  Eigen::Vector2d low;
  double texel = 0;
};

/// Texels whose middle a triangle covers, seen along y.
template <class Paint>
void forCovered(const Square& square, const std::array<Vec3, 3>& corners, Paint paint) {
  std::array<Eigen::Vector2d, 3> p;
  for (std::size_t i = 0; i < 3; ++i)
    p[i] = (Eigen::Vector2d(corners[i].x(), corners[i].z()) - square.low) / square.texel;
  const auto side = [](const Eigen::Vector2d& a, const Eigen::Vector2d& b, double x, double y) {
    return (b.x() - a.x()) * (y - a.y()) - (b.y() - a.y()) * (x - a.x());
  };
  const auto from = [](double least) { return std::max(0, static_cast<int>(std::floor(least))); };
  const auto to = [](double most) {
    return std::min(kTexels - 1, static_cast<int>(std::ceil(most)));
  };
  const auto [left, right] = std::minmax({p[0].x(), p[1].x(), p[2].x()});
  const auto [low, high] = std::minmax({p[0].y(), p[1].y(), p[2].y()});
  for (int row = from(low); row <= to(high); ++row)
    for (int column = from(left); column <= to(right); ++column) {
      const double x = column + 0.5, y = row + 0.5, a = side(p[0], p[1], x, y),
                   b = side(p[1], p[2], x, y), c = side(p[2], p[0], x, y);
      if ((a >= 0 && b >= 0 && c >= 0) || (a <= 0 && b <= 0 && c <= 0)) paint(column, row);
    }
}

/// Three running means in each direction: nearly a Gaussian (Wells 1986).
void blur(std::vector<float>* values, double sd_texels) {
  const int reach = std::clamp(static_cast<int>(std::lround(sd_texels)), 1, kTexels / 4);
  std::vector<float> line(kTexels);
  const auto mean = [&](std::size_t first, std::size_t step) {
    float sum = 0;
    const auto value = [&](int i) -> float& {
      return (*values)[first + step * static_cast<std::size_t>(std::clamp(i, 0, kTexels - 1))];
    };
    for (int i = -reach; i <= reach; ++i) sum += value(i);
    for (int i = 0; i < kTexels; ++i) {
      line[static_cast<std::size_t>(i)] = sum / static_cast<float>(2 * reach + 1);
      sum += value(i + reach + 1) - value(i - reach);
    }
    for (int i = 0; i < kTexels; ++i) value(i) = line[static_cast<std::size_t>(i)];
  };
  for (int time = 0; time < 3; ++time)
    for (std::size_t k = 0; k < kTexels; ++k) {
      mean(k * kTexels, 1);
      mean(k, kTexels);
    }
}

}  // namespace

GroundShade groundShade(const std::vector<const anatomy::TriangleMesh*>& meshes, double table_y,
                        const Eigen::Vector2d& middle, double half) {
  const Square square{middle - Eigen::Vector2d(half, half), 2 * half / kTexels};
  std::vector<float> outline(std::size_t{kTexels} * kTexels), touching = outline;
  double highest = 0;
  for (const anatomy::TriangleMesh* mesh : meshes)
    for (const auto& triangle : mesh->triangles) {
      std::array<Vec3, 3> corners;
      double above = 1e9;
      for (std::size_t i = 0; i < 3; ++i) {
        corners[i] = mesh->points[triangle[i]];
        above = std::min(above, table_y - corners[i].y());
        highest = std::max(highest, table_y - corners[i].y());
      }
      forCovered(square, corners, [&](int column, int row) {
        const std::size_t at =
            static_cast<std::size_t>(row) * kTexels + static_cast<std::size_t>(column);
        outline[at] = 1;
        if (above < kTouches) touching[at] = 1;
      });
    }
  blur(&outline, 0.35 * highest / square.texel);
  blur(&touching, kTouchBlur / square.texel);
  GroundShade shade{kTexels, std::move(outline)};
  for (std::size_t i = 0; i < shade.dark.size(); ++i)
    shade.dark[i] = 1 - (1 - kOutlineDark * shade.dark[i]) * (1 - kTouchDark * touching[i]);
  return shade;
}

namespace {

Eigen::AlignedBox3d boxOf(const std::vector<const anatomy::TriangleMesh*>& meshes) {
  Eigen::AlignedBox3d box;
  for (const anatomy::TriangleMesh* mesh : meshes)
    for (const Vec3& p : mesh->points) box.extend(p);
  return box;
}

std::vector<const anatomy::TriangleMesh*> skinsOf(const anatomy::Patient& patient) {
  std::vector<const anatomy::TriangleMesh*> skins;
  for (const anatomy::OrganSurface& organ : patient.organs)
    if (organ.organ == Organ::skin) skins.push_back(&organ.mesh);
  return skins;
}

/// Full in the middle, nothing at the rim of the square: a round patch without an edge.
double patch(double u, double v) {
  const double r = 2 * std::hypot(u - 0.5, v - 0.5);
  const double in = std::clamp((1 - r) / 0.75, 0.0, 1.0);
  return in * in * (3 - 2 * in);
}

std::vector<std::uint8_t> pictureOf(const GroundShade& shade) {
  std::vector<std::uint8_t> rgba;
  for (int row = 0; row < shade.texels; ++row)
    for (int column = 0; column < shade.texels; ++column) {
      const double light = 1 - shade.at(column, row);
      for (const double part : colour::kTable)
        rgba.push_back(static_cast<std::uint8_t>(std::lround(255 * light * part)));
      rgba.push_back(static_cast<std::uint8_t>(
          std::lround(255 * patch((column + 0.5) / shade.texels, (row + 0.5) / shade.texels))));
    }
  return rgba;
}

}  // namespace

std::optional<TableTop> tableUnder(const anatomy::Patient& patient) {
  const Eigen::AlignedBox3d box = boxOf(skinsOf(patient));
  if (box.isEmpty()) return std::nullopt;
  return TableTop{
      {box.center().x(), box.center().z()}, box.max().y(), 0.9 * box.sizes().maxCoeff() + 0.1};
}

Table::Table(vtkRenderer& renderer, const anatomy::Patient& patient) : sheet_(renderer) {
  const std::optional<TableTop> top = tableUnder(patient);
  if (!top) return;
  const auto [middle, y, half] = *top;
  sheet_.lay(1, 1, [&](double u, double v) {
    return Vec3(top->middle.x() + (2 * u - 1) * top->half, top->y,
                top->middle.y() + (2 * v - 1) * top->half);
  });
  const GroundShade shade = groundShade(skinsOf(patient), y, middle, half);
  sheet_.dye(shade.texels, shade.texels, pictureOf(shade));
  laid_ = true;
}

}  // namespace palpa::scene
