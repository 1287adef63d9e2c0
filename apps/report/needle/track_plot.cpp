#include <algorithm>
#include <array>
#include <cmath>

#include "apps/assess/needle/needle_views.h"
#include "apps/report/needle/trial_sections.h"
#include "apps/report/plot/chart_frame.h"
#include "apps/report/plot/path_data.h"

namespace palpa::report {
namespace {

using assess::NeedleTrack;
using assess::NeedleView;
using assess::NeedleViews;
using Eigen::Vector2d;

constexpr double kHead = 26, kFoot = 22;  // px above and below a view, for words
constexpr double kApartPx = 24;           // between views
constexpr double kNumber = 8.5;           // radius of a numbered mark
constexpr double kTremor = 1e-3;          // m of a tip's path that a picture leaves out

/// A view in its place on the picture.
struct Placed {
  const NeedleView& view;
  double left, top, scale;  // px, px, px per m

  double width() const { return scale * (view.high.x() - view.low.x()); }
  double height() const { return scale * (view.high.y() - view.low.y()); }
  double x(const Vector2d& p) const { return left + scale * (p.x() - view.low.x()); }
  double y(const Vector2d& p) const { return top + scale * (view.high.y() - p.y()); }
  /// No farther than the view's edge, less `px`.
  Vector2d held(const Vector2d& p, double px) const {
    const Vector2d rim = Vector2d::Constant(px / scale);
    return p.cwiseMax(view.low + rim).cwiseMin(view.high - rim);
  }
};

Placed placed(const NeedleView& view, double left, double top, double width, double height) {
  const Vector2d size = view.high - view.low;
  return {view, left, top, std::min(width / size.x(), height / size.y())};
}

/// Closed on what lies just outside of the view, so that a large organ makes a short path.
std::string outline(const Placed& at, const anatomy::SectionLine& line) {
  PathData path;
  for (const Vector2d& p : line.points) {
    const Vector2d near = at.held(p, -6);
    path.lineTo(at.x(near), at.y(near));
  }
  if (line.closed) path.close();
  return path.str();
}

void drawOrgans(Html& svg, const Placed& at) {
  for (const anatomy::SectionLine& line : at.view.cut)
    svgPath(svg, std::string("organ ") + palpa::name(line.organ), outline(at, line));
}

/// Over the needle's lines, so that they can be read.
void nameOrgans(Html& svg, const Placed& at) {
  for (const assess::OrganName& named : at.view.names) {
    const char* name = palpa::name(named.organ);
    const double half = kLongerElsewhere * textWidth(name, 12) / 2 + 2;
    svgText(svg, "organ-name mid",
            std::clamp(at.x(named.at), at.left + half, at.left + at.width() - half),
            at.y(named.at) + 4, name);
  }
}

void drawPass(Html& svg, const Placed& at, const Vector2d& p, std::size_t number) {
  const Vector2d held = at.held(p, kNumber + 1);
  const bool beyond = (held - p).norm() > 1e-9;
  svg.empty("circle", {{"class", beyond ? "pass beyond" : "pass"},
                       {"cx", coordinate(at.x(held))},
                       {"cy", coordinate(at.y(held))},
                       {"r", coordinate(kNumber)}});
  svgText(svg, "pass-number mid", at.x(held), at.y(held) + 3.8, std::to_string(number));
}

void drawRing(Html& svg, const Placed& at, const Vector2d& p, double radius) {
  svg.empty("circle", {{"class", "experts"},
                       {"cx", coordinate(at.x(p))},
                       {"cy", coordinate(at.y(p))},
                       {"r", coordinate(at.scale * radius)}});
}

void drawCross(Html& svg, const Placed& at, const Vector2d& p) {
  constexpr double kArm = 6;
  const double x = at.x(p), y = at.y(p);
  svgLine(svg, "taught", x - kArm, y, x + kArm, y);
  svgLine(svg, "taught", x, y - kArm, x, y + kArm);
}

void drawWay(Html& svg, const Placed& at, const NeedleViews& views,
             const std::vector<NeedleTrack>& tracks) {
  const auto to = [&](const Vec3& p_A) { return at.view.plane.at(p_A); };
  PathData taught, tips, needles;
  const Vector2d entry = to(views.entry_A), target = to(views.target_A);
  taught.moveTo(at.x(entry), at.y(entry));
  taught.lineTo(at.x(target), at.y(target));
  svgPath(svg, "taught dashed", taught.str());
  for (const NeedleTrack& track : tracks) {
    Vector2d before(0, 0);
    for (const Vec3& tip_A : track.tips_A) {
      const Vector2d p = to(tip_A);
      const bool first = &tip_A == &track.tips_A.front(), last = &tip_A == &track.tips_A.back();
      if (!first && !last && (p - before).norm() < kTremor) continue;
      first ? tips.moveTo(at.x(p), at.y(p)) : tips.lineTo(at.x(p), at.y(p));
      before = p;
    }
    const Vector2d tip = to(track.deepest.tip_A),
                   back = to(track.deepest.tip_A - assess::kShownShaft * track.deepest.axis_A);
    needles.moveTo(at.x(back), at.y(back));
    needles.lineTo(at.x(tip), at.y(tip));
  }
  if (tracks.empty()) return;
  svgPath(svg, "needle", needles.str());
  svgPath(svg, "tip-path", tips.str());
}

/// What reaches beyond a view is not seen.
Html::Scope clipped(Html& svg, const Placed& at) {
  const std::string x = coordinate(at.left), y = coordinate(at.top), w = coordinate(at.width()),
                    h = coordinate(at.height());
  return svg.in("svg", {{"x", x},
                        {"y", y},
                        {"width", w},
                        {"height", h},
                        {"viewBox", x + ' ' + y + ' ' + w + ' ' + h}});
}

/// Title and what is up above, a centimetre and what is right below.
void drawFrame(Html& svg, const Placed& at) {
  const double right = at.left + at.width(), foot = at.top + at.height() + kFoot - 5,
               cm = 0.01 * at.scale;
  svgText(svg, "label", at.left, at.top - 9, at.view.title);
  svgText(svg, "tick end", right, at.top - 9, std::string("↑ ") + at.view.up);
  svgRect(svg, "view", at.left, at.top, at.width(), at.height());
  svgLine(svg, "measure", at.left, foot - 4, at.left + cm, foot - 4);
  svgText(svg, "tick", at.left + cm + 6, foot, "1 cm");
  svgText(svg, "tick end", right, foot, std::string(at.view.across) + " →");
}

void drawViews(Html& svg, const std::array<Placed, 3>& at, const NeedleViews& views,
               const std::vector<NeedleTrack>& tracks) {
  const auto& [skin, way, vein] = at;
  for (const Placed& view : at) {
    const auto inside = clipped(svg, view);
    svgRect(svg, "view-ground", view.left, view.top, view.width(), view.height());
    drawOrgans(svg, view);
    if (&view == &way) drawWay(svg, way, views, tracks);
    nameOrgans(svg, view);
  }
  const Vector2d entry = skin.view.plane.at(views.entry_A),
                 target = vein.view.plane.at(views.target_A);
  if (views.entry_acceptable > 0) drawRing(svg, skin, entry, views.entry_acceptable);
  drawCross(svg, skin, entry);
  drawCross(svg, vein, target);
  for (std::size_t i = 0; i < tracks.size(); ++i) {
    drawPass(svg, skin, skin.view.plane.at(tracks[i].puncture_A), i + 1);
    if (const auto aim = assess::aimOf(tracks[i].deepest, vein.view.plane))
      drawPass(svg, vein, *aim, i + 1);
  }
  for (const Placed& view : at) drawFrame(svg, view);
}

std::string passes(std::size_t count) {
  return count == 0   ? "no pass of the needle"
         : count == 1 ? "one pass of the needle"
                      : std::to_string(count) + " passes of the needle";
}

void drawTrack(Html& html, const ChartFrame& frame, const NeedleViews& views,
               const std::vector<NeedleTrack>& tracks) {
  const std::string label = "Entry, way and aim of " + passes(tracks.size());
  if (frame.wide) {
    const Vector2d way_size = views.way.high - views.way.low;
    const double side = (frame.width - 2 * kApartPx) / (2 + way_size.x() / way_size.y());
    const Placed skin = placed(views.skin, 0, kHead, side, side),
                 way = placed(views.way, side + kApartPx, kHead, frame.width, side),
                 vein = placed(views.vein, frame.width - side, kHead, side, side);
    const auto svg = openSvg(html, frame, kHead + side + kFoot, label);
    drawViews(html, {skin, way, vein}, views, tracks);
    return;
  }
  const double width = frame.width - 2, between = kFoot + kApartPx + kHead;
  const Placed skin = placed(views.skin, 1, kHead, width, width),
               way = placed(views.way, 1, skin.top + skin.height() + between, width, width),
               vein = placed(views.vein, 1, way.top + way.height() + between, width, width);
  const auto svg = openSvg(html, frame, vein.top + vein.height() + kFoot, label);
  drawViews(html, {skin, way, vein}, views, tracks);
}

}  // namespace

void writeTrack(Html& html, const NeedleViews& views,
                const std::vector<assess::TrialSample>& samples) {
  const std::vector<NeedleTrack> tracks = assess::needleTracks(samples);
  html.element("h3", "Where the needle went");
  const auto figure = html.in("figure", {{"class", "track"}});
  drawTrack(html, kWide, views, tracks);
  drawTrack(html, kNarrow, views, tracks);
  if (tracks.empty()) return html.element("figcaption", "The needle did not pierce the skin.");
  html.element("figcaption",
               std::string("Crosses and the dashed line: as it is taught on this patient") +
                   (views.entry_acceptable > 0 ? "; circle: where experts go in" : "") +
                   ". Numbers: passes of the needle, where each went in and what it was aimed at "
                   "when it was deepest. A dashed rim: beyond the picture. In section: the "
                   "tip's path without what is under a millimetre, and the needle where each pass "
                   "was deepest. The skin is drawn as "
                   "it lies untouched: it gives way under the needle before it is pierced.");
}

std::string_view trackStyle() {
  return R"css(
.track svg .view{fill:none;stroke:var(--line)}
.track .view-ground{fill:var(--card)}
.track .organ{fill:color-mix(in srgb,var(--phase) 55%,var(--card));stroke:var(--plain);
  stroke-width:1}
.track .organ.skin{fill:color-mix(in srgb,var(--guide) 10%,var(--card))}
.track .organ.muscle{fill:color-mix(in srgb,var(--bad) 14%,var(--card));stroke:none}
.track .organ.lung{fill:color-mix(in srgb,var(--plain) 24%,var(--card));stroke-dasharray:5 3}
.track .organ.vein{fill:color-mix(in srgb,var(--blue) 42%,var(--card));stroke:var(--blue);
  stroke-width:1.6}
.track .organ.artery{fill:color-mix(in srgb,var(--bad) 48%,var(--card));stroke:var(--bad);
  stroke-width:1.6}
.track .organ-name{fill:var(--ink);font-size:12px;paint-order:stroke;stroke:var(--card);
  stroke-width:3px;stroke-linejoin:round}
.track .taught{fill:none;stroke:var(--good);stroke-width:2}
.track .dashed{stroke-dasharray:6 4}
.track .experts{fill:color-mix(in srgb,var(--good) 18%,transparent);stroke:var(--good)}
.track .tip-path{fill:none;stroke:var(--ink);stroke-width:1.2}
.track .needle{fill:none;stroke:var(--ink);stroke-width:2.6;stroke-linecap:round;opacity:.55}
.track .pass{fill:var(--ink);stroke:var(--card);stroke-width:1.5}
.track .pass.beyond{stroke:var(--bad);stroke-dasharray:3 2}
.track .pass-number{fill:var(--card);font-size:11px;font-weight:650}
.track .measure{stroke:var(--ink);stroke-width:2}
)css";
}

}  // namespace palpa::report
