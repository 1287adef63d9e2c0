#include "apps/evidence/needle_track.h"

#include <cmath>
#include <nlohmann/json.hpp>

namespace palpa::evidence {
namespace {

using assess::NeedleView;
using assess::TrialSample;
using Eigen::Vector2d;
using nlohmann::json;

constexpr double kStep_s = 0.05;  // between two places of the needle

double inMillimetres(double m) { return std::round(1e4 * m) / 10; }

json point(const Vector2d& p) { return {inMillimetres(p.x()), inMillimetres(p.y())}; }

json linesOf(const NeedleView& view) {
  json lines = json::array();
  for (const anatomy::SectionLine& line : view.cut) {
    json points = json::array();
    for (const Vector2d& p : line.points) points.push_back(point(p));
    lines.push_back({{"organ", name(line.organ)}, {"closed", line.closed}, {"points", points}});
  }
  return lines;
}

json namesOf(const NeedleView& view) {
  json names = json::array();
  for (const assess::OrganName& named : view.names)
    names.push_back({{"organ", name(named.organ)}, {"at", point(named.at)}});
  return names;
}

json viewOf(const NeedleView& view, const char* kind, const assess::NeedleViews& views) {
  return {{"kind", kind},
          {"title", view.title},
          {"across", view.across},
          {"up", view.up},
          {"low", point(view.low)},
          {"high", point(view.high)},
          {"lines", linesOf(view)},
          {"names", namesOf(view)},
          {"entry", point(view.plane.at(views.entry_A))},
          {"target", point(view.plane.at(views.target_A))},
          {"needle", json::array()}};
}

/// [u, v] of the tip, and of a point on the shaft where it is asked for.
json needleIn(const NeedleView& view, const TrialSample& at, bool shaft) {
  json ends = json::array({point(view.plane.at(at.tip_A))});
  if (shaft) ends.push_back(point(view.plane.at(at.tip_A - assess::kShownShaft * at.axis_A)));
  return ends;
}

json aimIn(const NeedleView& view, const TrialSample& at) {
  if (at.phase == haptics::NeedlePhase::outside) return nullptr;
  const auto aim = assess::aimOf(at, view.plane);
  return aim ? json::array({point(*aim)}) : json(nullptr);
}

}  // namespace

json needleTrack(const assess::NeedleViews& views, const NeedleSamples& samples) {
  json skin = viewOf(views.skin, "skin", views), way = viewOf(views.way, "way", views),
       vein = viewOf(views.vein, "vein", views), t_s = json::array();
  double next_s = 0;
  for (const TrialSample& sample : samples) {
    if (sample.t_s < next_s) continue;
    next_s = sample.t_s + kStep_s;
    t_s.push_back(std::round(1e3 * sample.t_s) / 1e3);
    skin["needle"].push_back(needleIn(views.skin, sample, false));
    way["needle"].push_back(needleIn(views.way, sample, true));
    vein["needle"].push_back(aimIn(views.vein, sample));
  }
  json entries = json::array();
  for (const assess::NeedleTrack& track : assess::needleTracks(samples))
    entries.push_back(point(views.skin.plane.at(track.puncture_A)));
  skin["passes"] = entries;
  skin["experts_mm"] = inMillimetres(views.entry_acceptable);
  return {{"views", {skin, way, vein}}, {"t_s", t_s}};
}

}  // namespace palpa::evidence
