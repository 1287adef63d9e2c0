#include "apps/report/search/search_figures.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>

#include "anatomy/base/whole_file.h"
#include "apps/report/page/page_parts.h"
#include "apps/report/page/style.h"
#include "apps/report/plot/path_data.h"

namespace palpa::report {
namespace {

constexpr double kDot = 0.1;        // px: what lasts a tick is a dot
constexpr double kStepOfWay = 0.4;  // U: between the points of a line that is drawn
constexpr double kKeyRow = 20;      // px
constexpr double kPale = 5;         // U: of a floor that lies under something else

struct FloorFigure {
  const char* file;
  MapPlot plot;
  DrawOver over;
  std::string caption;
};

double largestIn(const MapValues& map) {
  double largest = 0;
  for (const float value : map.values)
    largest = std::max(largest, std::abs(static_cast<double>(value)));
  return largest > 0 ? largest : 1;
}

std::pair<double, double> rangeOf(const MapValues& map) {
  const auto [low, high] = std::minmax_element(map.values.begin(), map.values.end());
  if (low == map.values.end() || !(*high > *low)) return {-1, 1};
  return {static_cast<double>(*low), static_cast<double>(*high)};
}

MapPlot heightPlot(const MapValues& map, const std::string& label, double largest) {
  const auto [low, high] = rangeOf(map);
  return {map, label, "U", "height, U", low, high, largest};
}

void nameElements(Html& svg, const std::vector<ElementMark>& elements, const Axis& x,
                  const Axis& y) {
  for (const ElementMark& e : elements)
    svgText(svg, "on-map mid", x.at(e.x), y.at(e.y) + 4, e.target ? "target" : "distractor");
}

/// A line through the places for which `belongs`; it ends where they do.
template <typename Belongs>
std::string lineOf(const std::vector<ProbePlace>& way, const Axis& x, const Axis& y,
                   Belongs belongs) {
  PathData path;
  double last_x = 0, last_y = 0;
  bool on = false;
  for (const ProbePlace& p : way) {
    const bool now = belongs(p);
    if (now && (!on || std::hypot(p.x - last_x, p.y - last_y) >= kStepOfWay)) {
      if (!on) path.moveTo(x.at(p.x) - kDot, y.at(p.y));
      path.lineTo(x.at(p.x), y.at(p.y));
      last_x = p.x;
      last_y = p.y;
    }
    on = now;
  }
  return path.str();
}

/// Below the map, in two columns.
void drawWayKey(Html& svg, const SearchFigures& f, const Axis& x, const Axis& y) {
  std::vector<std::pair<std::string, std::string>> entries{{"way", "on the floor"},
                                                           {"way air", "above the floor"}};
  for (std::size_t i = 0; i < f.cues.size(); ++i)
    entries.emplace_back("way cue-" + std::to_string(i), "cue: " + f.cues[i]);
  for (std::size_t i = 0; i < entries.size(); ++i) {
    const double left = x.from_px + (i % 2 == 0 ? 0 : 180),
                 line = y.from_px + kMapFoot + kKeyRow * (static_cast<double>(i / 2) + 0.8);
    svgLine(svg, entries[i].first + " key", left, line - 4, left + 26, line - 4);
    svgText(svg, "label", left + 34, line, entries[i].second);
  }
}

void drawWay(Html& svg, const SearchFigures& f, const Axis& x, const Axis& y) {
  const auto put = [&](const std::string& css, const std::string& d) {
    if (!d.empty()) svgPath(svg, css, d);
  };
  put("way air", lineOf(f.way, x, y, [](const ProbePlace& p) { return !p.touching; }));
  put("way", lineOf(f.way, x, y, [](const ProbePlace& p) { return p.touching; }));
  for (std::size_t i = 0; i < f.cues.size(); ++i)
    put("way cue-" + std::to_string(i),
        lineOf(f.way, x, y, [i](const ProbePlace& p) { return p.cues >> i & 1u; }));
  for (const ElementMark& e : f.elements)
    if (e.chosen) svgPath(svg, "chosen", markPath(Tone::good, x.at(e.x), y.at(e.y), 9));
  drawWayKey(svg, f, x, y);
}

std::string textureWords(const char* whose, const TexturedDisc& disc) {
  return std::string("Texture of ") + whose + ": hemispheres of radius " + trimmed(disc.bump_U, 2) +
         " U on a grid of " + trimmed(disc.grid_U, 2) +
         " U, each moved by chance within a square of " + trimmed(disc.jitter_U, 2) + " U.";
}

std::string filterWords(const EdgeFilter& filter) {
  return "The filter that tells where the floor rises, one of 160: an antisymmetric Gabor filter "
         "of "
         "the direction " +
         fixed(filter.direction_rad, 3) + " rad, σ = " + trimmed(filter.sigma_U, 2) +
         " U, γ = " + trimmed(filter.aspect, 2) + ".";
}

std::vector<FloorFigure> figuresOf(const SearchFigures& f) {
  const auto names = [&f](Html& svg, const Axis& x, const Axis& y) {
    nameElements(svg, f.elements, x, y);
  };
  const double deep = largestIn(f.floor), most = largestIn(f.response);
  std::vector<FloorFigure> all{
      {"stimulus.svg", heightPlot(f.smooth, "Heights of the floor without texture", deep), names,
       "The stimulus without its texture: three discs, around each a groove, in its middle a pit. "
       "1 U is " +
           trimmed(f.unit_mm, 3) + " mm in the hand. (Figure 1.)"},
      {"texture-target.svg",
       heightPlot(f.target.heights, "Heights of the target's texture", deep),
       {},
       textureWords("the target", f.target) + " (Figure 3 a.)"},
      {"texture-distractor.svg",
       heightPlot(f.distractor.heights, "Heights of a distractor's texture", deep),
       {},
       textureWords("the distractors", f.distractor) + " (Figure 3 b.)"},
      {"floor.svg",
       heightPlot(f.floor, "Heights of the floor as it is felt", deep),
       {},
       "The floor as it is felt, with texture. (Figure 4 a.)"},
      {"filter.svg",
       {f.filter.values, "Edge filter", "U", "of its largest", -1, 1, 1},
       {},
       filterWords(f.filter) + " (Figure 5.)"},
      {"response.svg",
       {f.response, "Response of the floor to the filter", "U", "response, U", -most, most, most},
       {},
       "The response of the floor without texture to this filter: orange where it rises, blue "
       "where "
       "it falls, for a probe that moves fast in that direction. Where it rises most a cue pushes. "
       "(Figure 4 b.)"}};
  if (f.way.empty()) return all;
  MapPlot way = heightPlot(f.smooth, "The probe's way over the floor", kPale);
  way.foot_px = kKeyRow * static_cast<double>((f.cues.size() + 3) / 2);
  all.push_back({"way.svg", way,
                 [&f](Html& svg, const Axis& x, const Axis& y) { drawWay(svg, f, x, y); },
                 "The probe's way in episode " + std::to_string(f.trial) + " (" + f.mode +
                     "), and where which cue added force. Ring: the element that was chosen."});
  return all;
}

constexpr const char* kOverStyle =
    ".on-map{paint-order:stroke;stroke:#fff;stroke-width:4px;stroke-linejoin:round;fill:#18212b}"
    ".on-map.mid{text-anchor:middle}"
    ".way{fill:none;stroke:#18212b;stroke-width:1;stroke-linejoin:round;stroke-linecap:round}"
    ".way.air{stroke-opacity:.55;stroke-dasharray:1 3}"
    ".way.cue-0{stroke:#D55E00;stroke-width:4}"
    ".way.cue-1{stroke:#009E73;stroke-width:3;stroke-dasharray:7 4}"
    ".way.cue-2{stroke:#CC79A7;stroke-width:4;stroke-dasharray:1 5}"
    ".way.cue-3{stroke:#0072B2;stroke-width:3;stroke-dasharray:9 3 1 3}"
    ".chosen{fill:none;stroke:#18212b;stroke-width:2.5}";

}  // namespace

std::string searchFiguresStyle() {
  return std::string(
             ".maps{display:grid;grid-template-columns:repeat(auto-fit,minmax(min(380px,100%),1fr))"
             ";"
             "gap:28px 32px}.maps svg{max-width:480px}"
             "svg .map-frame{fill:none;stroke:var(--muted)}"
             "svg text.on-map{fill:#18212b}"
             "@media screen and (prefers-color-scheme: dark)"
             "{svg .way.key:not([class*=cue]){stroke:#e8ebee}}") +
         kOverStyle + '\n';
}

void writeSearchFigures(Html& html, const SearchFigures& figures) {
  const auto section = html.in("section", {{"class", "card"}, {"id", "floor"}});
  html.element("h2", "The floor of episode " + std::to_string(figures.trial) +
                         ": stimulus, texture and response");
  html.element("p", {{"class", "muted small"}},
               "Drawn after Edmunds and Pai, Perceptually augmented simulator design (2012); in "
               "brackets the numbers of its figures.");
  const auto grid = html.in("div", {{"class", "maps"}});
  for (const FloorFigure& figure : figuresOf(figures)) {
    const auto element = html.in("figure");
    drawMap(html, figure.plot, figure.over);
    html.element("figcaption", figure.caption);
  }
}

std::vector<std::string> writeFigureFiles(const SearchFigures& figures,
                                          const std::filesystem::path& folder) {
  std::vector<std::string> names{"figures.html"};
  for (const FloorFigure& figure : figuresOf(figures)) {
    writeWhole(folder / figure.file, mapFile(figure.plot, figure.over, kOverStyle));
    names.emplace_back(figure.file);
  }
  Html html;
  html.raw("<!doctype html>\n");
  {
    const auto root = html.in("html", {{"lang", "en"}});
    writeHeadElement(html, "Stimulus, texture and response", "", searchFiguresStyle());
    const auto body = html.in("body");
    const auto main = html.in("main");
    writeSearchFigures(html, figures);
  }
  writeWhole(folder / names[0], html.page() + '\n');
  return names;
}

}  // namespace palpa::report
