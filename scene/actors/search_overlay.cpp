#include "scene/actors/search_overlay.h"

#include <vtkRenderer.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <vector>

namespace palpa::scene {
namespace {

constexpr double kOverSurface =
    0.0004;                       // m; a surface in the same plane would show through in stripes
constexpr int kCell_texels = 12;  // a cell's edge, less where there are many
constexpr int kMost_texels = 2048;
constexpr double kSeam =
    0.62;  // opacity of a cell's rim, in parts of its own: cells can be counted

bool isSound(const CoverageGrid& grid) {
  return grid.columns > 0 && grid.rows > 0 && std::max(grid.columns, grid.rows) <= kMost_texels &&
         grid.cell_x > 0 && grid.cell_y > 0 &&
         grid.levels.size() ==
             static_cast<std::size_t>(grid.columns) * static_cast<std::size_t>(grid.rows);
}

bool sameSheet(const CoverageGrid& a, const CoverageGrid& b) {
  return a.columns == b.columns && a.rows == b.rows && a.cell_x == b.cell_x &&
         a.cell_y == b.cell_y && a.X_AG.matrix() == b.X_AG.matrix() && a.top == b.top &&
         a.outline == b.outline;
}

Rgba feltColour(std::uint8_t level) {
  switch (level) {
    case 0:
    case CoverageGrid::kNotAsked:
      return {colour::kFeltLight[0], colour::kFeltLight[1], colour::kFeltLight[2], 0};
    case 1:
      return colour::kFeltLight;
    case 2:
      return colour::kFeltMedium;
    default:
      return colour::kFeltDeep;
  }
}

std::uint8_t toByte(double share) {
  return static_cast<std::uint8_t>(std::lround(255 * std::clamp(share, 0.0, 1.0)));
}

/// How many pieces a curved sheet has for each cell: then it stays above the skin's mesh.
constexpr int kPieces = 3;

Vec3 overTop(const CoverageGrid& grid, double x, double y) {
  return grid.X_AG * fromTop(grid.top, Vec3(x, y, kOverSurface));
}

/// From (-1, -1) to (1, 1) over the grid.
Vec3 overGrid(const CoverageGrid& grid, double u, double v) {
  return overTop(grid, u * 0.5 * grid.columns * grid.cell_x, v * 0.5 * grid.rows * grid.cell_y);
}

std::vector<Eigen::Vector2d> cornersOf(const CoverageGrid& grid) {
  if (grid.outline.size() >= 3) return grid.outline;
  const double x = 0.5 * grid.columns * grid.cell_x, y = 0.5 * grid.rows * grid.cell_y;
  return {{-x, -y}, {x, -y}, {x, y}, {-x, y}};
}

/// Once around, in short pieces where the top is curved.
std::vector<Vec3> edgeOf(const CoverageGrid& grid) {
  constexpr double kPiece = 2e-3;  // m
  const std::vector<Eigen::Vector2d> corners = cornersOf(grid);
  std::vector<Vec3> edge;
  for (std::size_t i = 0; i < corners.size(); ++i) {
    const Eigen::Vector2d& from = corners[i];
    const Eigen::Vector2d way = corners[(i + 1) % corners.size()] - from;
    const int pieces =
        grid.top.flat() ? 1 : std::max(1, static_cast<int>(std::ceil(way.norm() / kPiece)));
    for (int k = 0; k < pieces; ++k)
      edge.push_back(
          overTop(grid, from.x() + way.x() * k / pieces, from.y() + way.y() * k / pieces));
  }
  edge.push_back(edge.front());
  return edge;
}

}  // namespace

CoverageCarpet::CoverageCarpet(vtkRenderer& renderer, double outline_px)
    : carpet_(renderer), outline_(renderer, colour::kText, outline_px) {}

CoverageCarpet::~CoverageCarpet() = default;

void CoverageCarpet::lay(const CoverageGrid& grid) {
  const bool flat = grid.top.flat();
  carpet_.lay(flat ? 1 : kPieces * grid.columns, flat ? 1 : kPieces * grid.rows,
              [&](double u, double v) { return overGrid(grid, 2 * u - 1, 2 * v - 1); });
  outline_.show({edgeOf(grid)});
}

// Texels of clear cells have a colour too: sampling between two texels mixes it in.
void CoverageCarpet::dye(const CoverageGrid& grid) {
  const int side = std::clamp(kMost_texels / std::max(grid.columns, grid.rows), 1, kCell_texels);
  const int width = side * grid.columns, height = side * grid.rows;
  std::vector<std::uint8_t> rgba(4 * static_cast<std::size_t>(width) *
                                 static_cast<std::size_t>(height));
  std::uint8_t* texel = rgba.data();
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x, texel += 4) {
      const Rgba ink = feltColour(
          grid.levels[static_cast<std::size_t>(y / side) * static_cast<std::size_t>(grid.columns) +
                      static_cast<std::size_t>(x / side)]);
      const bool rim = side > 3 && (x % side == 0 || y % side == 0);
      for (std::size_t k = 0; k < 3; ++k) texel[k] = toByte(ink[k]);
      texel[3] = toByte(rim ? kSeam * ink[3] : ink[3]);
    }
  }
  carpet_.dye(width, height, rgba);
}

void CoverageCarpet::update(const std::optional<CoverageGrid>& grid, bool visible) {
  const bool shown = visible && grid && isSound(*grid);
  if (shown && !(drawn_ && sameSheet(*drawn_, *grid))) lay(*grid);
  if (shown && !(drawn_ && drawn_->columns == grid->columns && drawn_->levels == grid->levels))
    dye(*grid);
  if (shown && !(drawn_ && sameSheet(*drawn_, *grid) && drawn_->levels == grid->levels))
    drawn_ = grid;
  carpet_.setVisible(shown);
  outline_.setVisible(shown);
}

namespace {

constexpr double kLeadRadius = 0.010;  // m: a fingertip stands in it
constexpr double kLeadTick = 0.004;
constexpr double kLeadLift = 0.001;  // toward the viewer, off the surface

/// A ring about the origin, and four ticks that point to its middle.
std::vector<std::vector<Vec3>> leadShape(const Pose& X_A) {
  constexpr int kSteps = 48;
  const auto at = [&](double radius, double share) {
    const double angle = 2 * std::numbers::pi * share;
    return Vec3(X_A * Vec3(radius * std::cos(angle), radius * std::sin(angle), 0));
  };
  std::vector<std::vector<Vec3>> lines(1);
  for (int i = 0; i <= kSteps; ++i)
    lines[0].push_back(at(kLeadRadius, static_cast<double>(i) / kSteps));
  for (const double share : {0.0, 0.25, 0.5, 0.75})
    lines.push_back({at(kLeadRadius, share), at(kLeadRadius + kLeadTick, share)});
  return lines;
}

}  // namespace

SearchOverlay::SearchOverlay(vtkRenderer& on_skin, vtkRenderer& above, double line_px)
    : map_(on_skin),
      carpet_(on_skin, 0.6 * line_px),
      lead_(on_skin, colour::kText, line_px),
      balls_(on_skin, above, 0.9 * line_px),
      pins_(above) {}

SearchOverlay::~SearchOverlay() = default;

/// Across the top of a grid at a place of it.
Mat3 layOn(const CoverageGrid& grid, const Vec3& p_A) {
  Mat3 R = grid.X_AG.linear();
  if (grid.top.flat()) return R;
  const Vec3 p_G = grid.X_AG.inverse() * p_A;
  return R * turnToNormal(normalOf(grid.top, p_G.x(), p_G.y()));
}

// On what is searched, where that is known; else toward the eye.
void SearchOverlay::showLead(const SceneState& state, bool visible, const Sight& sight) {
  if (!visible || !state.lead_A) return lead_.hide();
  const Mat3 R = state.coverage ? layOn(*state.coverage, *state.lead_A) : sight.facing();
  const Pose at = makePose(R, *state.lead_A + kLeadLift * R.col(2));
  if (lead_drawn_ && at.matrix() == lead_at_.matrix()) return lead_.setVisible(true);
  lead_.show(leadShape(at));
  lead_at_ = at;
  lead_drawn_ = true;
}

void SearchOverlay::update(const SceneState& state, bool visible, const Sight& sight,
                           double pin_px) {
  balls_above_ = state.skin == SkinStyle::solid;
  map_.update(state.surface_map, visible);
  std::optional<CoverageGrid> felt = state.coverage;
  if (felt && map_.visible()) std::fill(felt->levels.begin(), felt->levels.end(), std::uint8_t{0});
  carpet_.update(felt, visible);
  balls_.update(visible ? state.lumps : std::vector<ShownLump>(), sight, balls_above_);
  pins_.update(visible ? state.marks_A : std::vector<Vec3>(), sight, pin_px);
  showLead(state, visible, sight);
}

}  // namespace palpa::scene
