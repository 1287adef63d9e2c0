#include "apps/report/plot/map_plot.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <memory>

#include <cairo/cairo.h>

#include "anatomy/base/error.h"
#include "anatomy/base/text_forms.h"
#include "apps/report/page/page_parts.h"

namespace palpa::report {
namespace {

constexpr double kMapLeft = 58, kMapTop = 30, kMapSide = 330, kBarGap = 20, kBarWide = 16,
                 kBarWords = 56;  // px
constexpr int kBarSteps = 64;

struct MapHue {
  double r, g, b;  // 0 to 255
};
/// From the middle outward: below and above 0. Blues and oranges of ColorBrewer (Harrower & Brewer
/// 2003), which say they are safe for colour-blind readers.
constexpr std::array<MapHue, 5> kBelow{
    {{247, 247, 247}, {198, 219, 239}, {107, 174, 214}, {33, 113, 181}, {8, 48, 107}}};
constexpr std::array<MapHue, 5> kAbove{
    {{247, 247, 247}, {253, 208, 162}, {253, 141, 60}, {217, 72, 1}, {127, 39, 4}}};

std::uint32_t pixelOf(double value, double largest) {
  if (!std::isfinite(value)) return 0x808080;
  const auto& hues = value < 0 ? kBelow : kAbove;
  const double at = std::min(std::abs(value) / largest, 1.0) * (hues.size() - 1);
  const std::size_t i = std::min(static_cast<std::size_t>(at), hues.size() - 2);
  const double share = at - static_cast<double>(i);
  const auto mix = [&](double a, double b) {
    return static_cast<std::uint32_t>(std::lround(a + share * (b - a)));
  };
  return mix(hues[i].r, hues[i + 1].r) << 16 | mix(hues[i].g, hues[i + 1].g) << 8 |
         mix(hues[i].b, hues[i + 1].b);
}

cairo_status_t appendPng(void* bytes, const unsigned char* data, unsigned length) {
  static_cast<std::string*>(bytes)->append(reinterpret_cast<const char*>(data), length);
  return CAIRO_STATUS_SUCCESS;
}

void putPicture(Html& svg, double x, double y, double width, double height,
                const std::string& png) {
  svg.empty("image", {{"x", coordinate(x)},
                      {"y", coordinate(y)},
                      {"width", coordinate(width)},
                      {"height", coordinate(height)},
                      {"preserveAspectRatio", "none"},
                      {"href", "data:image/png;base64," + base64(png)}});
}

/// Where the parts of the picture are.
struct MapRoom {
  Axis x, y;
  double width = 0, height = 0;
  explicit MapRoom(const MapPlot& plot) {
    const MapValues& map = plot.map;
    const double high = kMapSide * (map.y_to - map.y_from) / (map.x_to - map.x_from);
    x = {map.x_from, map.x_to, kMapLeft, kMapLeft + kMapSide};
    y = {map.y_from, map.y_to, kMapTop + high, kMapTop};
    width = x.to_px + kBarGap + kBarWide + kBarWords;
    height = y.from_px + kMapFoot + plot.foot_px;
  }
};

void drawSides(Html& svg, const MapPlot& plot, const MapRoom& room) {
  svgRect(svg, "map-frame", room.x.from_px, room.y.to_px, kMapSide, room.y.from_px - room.y.to_px);
  for (const double value : niceTicks(room.x.from, room.x.to, 7).values) {
    svgLine(svg, "axis", room.x.at(value), room.y.from_px, room.x.at(value), room.y.from_px + 4);
    svgText(svg, "tick mid", room.x.at(value), room.y.from_px + 18, trimmed(value, 1));
  }
  for (const double value : niceTicks(room.y.from, room.y.to, 7).values) {
    svgLine(svg, "axis", room.x.from_px - 4, room.y.at(value), room.x.from_px, room.y.at(value));
    svgText(svg, "tick end", room.x.from_px - 8, room.y.at(value) + 4, trimmed(value, 1));
  }
  svgText(svg, "label mid", (room.x.from_px + room.x.to_px) / 2, room.y.from_px + 40,
          "x, " + plot.unit);
  svgText(svg, "label", 0, room.y.to_px - 12, "y, " + plot.unit);
}

void drawBar(Html& svg, const MapPlot& plot, const MapRoom& room) {
  MapValues bar{1, kBarSteps, 0, 1, plot.from, plot.to, {}};
  for (int j = 0; j < kBarSteps; ++j)
    bar.values.push_back(
        static_cast<float>(plot.from + (plot.to - plot.from) * (j + 0.5) / kBarSteps));
  const double left = room.x.to_px + kBarGap;
  const Axis up{plot.from, plot.to, room.y.from_px, room.y.to_px};
  putPicture(svg, left, up.to_px, kBarWide, up.from_px - up.to_px, mapPng(bar, plot.largest));
  svgRect(svg, "map-frame", left, up.to_px, kBarWide, up.from_px - up.to_px);
  const Ticks ticks = niceTicks(plot.from, plot.to, 7);
  for (const double value : ticks.values) {
    svgLine(svg, "axis", left + kBarWide, up.at(value), left + kBarWide + 4, up.at(value));
    svgText(svg, "tick", left + kBarWide + 8, up.at(value) + 4, ticks.label(value));
  }
  svgText(svg, "label end", room.width, up.to_px - 12, plot.quantity);
}

void drawInto(Html& html, const MapPlot& plot, const DrawOver& over, const std::string& style) {
  const MapRoom room(plot);
  const auto svg =
      html.in("svg", {{"xmlns", "http://www.w3.org/2000/svg"},
                      {"class", "chart map"},
                      {"viewBox", "0 0 " + coordinate(room.width) + ' ' + coordinate(room.height)},
                      {"role", "img"},
                      {"aria-label", plot.label}});
  if (!style.empty()) html.element("style", style);
  html.element("title", plot.label);
  putPicture(html, room.x.from_px, room.y.to_px, kMapSide, room.y.from_px - room.y.to_px,
             mapPng(plot.map, plot.largest));
  if (over) over(html, room.x, room.y);
  drawSides(html, plot, room);
  drawBar(html, plot, room);
}

/// What a page's style sheet has for charts, on white paper.
constexpr const char* kFileStyle =
    "svg{background:#fff}text{font:13px 'DejaVu Sans',sans-serif;fill:#18212b}"
    "text.tick{fill:#56616e}text.mid{text-anchor:middle}text.end{text-anchor:end}"
    ".axis{stroke:#56616e}.map-frame{fill:none;stroke:#56616e}";

}  // namespace

std::string mapColour(double value, double largest) {
  char text[8];
  std::snprintf(text, sizeof text, "#%06x", pixelOf(value, largest));
  return text;
}

std::string mapPng(const MapValues& map, double largest) {
  if (map.columns < 1 || map.rows < 1 || !(largest > 0) ||
      map.values.size() !=
          static_cast<std::size_t>(map.columns) * static_cast<std::size_t>(map.rows))
    throw Error("does not have as many values as pixels", "a map", "Make it again");
  const std::unique_ptr<cairo_surface_t, decltype(&cairo_surface_destroy)> surface(
      cairo_image_surface_create(CAIRO_FORMAT_RGB24, map.columns, map.rows),
      &cairo_surface_destroy);
  cairo_surface_flush(surface.get());
  unsigned char* bytes = cairo_image_surface_get_data(surface.get());
  const int stride = cairo_image_surface_get_stride(surface.get());
  for (int j = 0; bytes && j < map.rows; ++j) {
    auto* row = reinterpret_cast<std::uint32_t*>(bytes + static_cast<std::ptrdiff_t>(stride) * j);
    const std::size_t first =
        static_cast<std::size_t>(map.rows - 1 - j) * static_cast<std::size_t>(map.columns);
    for (std::size_t i = 0; i < static_cast<std::size_t>(map.columns); ++i)
      row[i] = pixelOf(static_cast<double>(map.values[first + i]), largest);
  }
  cairo_surface_mark_dirty(surface.get());
  std::string png;
  if (cairo_surface_write_to_png_stream(surface.get(), appendPng, &png) != CAIRO_STATUS_SUCCESS)
    throw Error("could not be drawn", "a map", "Is there memory left?");
  return png;
}

void drawMap(Html& html, const MapPlot& plot, const DrawOver& over) {
  drawInto(html, plot, over, "");
}

std::string mapFile(const MapPlot& plot, const DrawOver& over, const std::string& style) {
  Html svg;
  drawInto(svg, plot, over, kFileStyle + style);
  return svg.str() + '\n';
}

}  // namespace palpa::report
