#include "apps/assess/palpation/palpation_score.h"

#include <algorithm>
#include <limits>
#include <tuple>

#include "anatomy/base/pinned_math.h"

namespace palpa::assess {

double fromLine(const NormalAnatomy& anatomy, const Vec3& p_P) {
  double nearest = std::numeric_limits<double>::infinity();
  const Eigen::Vector2d p = p_P.head<2>();
  for (std::size_t i = 0; i < anatomy.line_P.size(); ++i) {
    const Eigen::Vector2d from = anatomy.line_P[i].head<2>(),
                          along =
                              anatomy.line_P[std::min(i + 1, anatomy.line_P.size() - 1)].head<2>() -
                              from;
    const double length2 = along.squaredNorm(),
                 part = length2 > 0 ? std::clamp((p - from).dot(along) / length2, 0.0, 1.0) : 0;
    nearest = std::min(nearest, (p - from - part * along).norm());
  }
  return nearest;
}

const NormalAnatomy* anatomyAt(const std::vector<NormalAnatomy>& all, const Vec3& p_P,
                               double reach) {
  const auto on = [&](const NormalAnatomy& one) {
    return fromLine(one, p_P) <= one.width / 2 + reach;
  };
  const auto found = std::find_if(all.begin(), all.end(), on);
  return found == all.end() ? nullptr : &*found;
}

namespace {

double apart(const Vec3& a, const Vec3& b) { return (a - b).head<2>().norm(); }

/// Marks to lumps; returns which marks are taken, and counts the others.
void giveMarks(const PalpationRules& rules, const std::vector<CaseLump>& lumps,
               const std::vector<LumpMark>& marks, PalpationScore* score,
               std::vector<bool>* false_alarm) {
  struct Pair {
    double distance;
    std::size_t lump, mark;
  };
  std::vector<Pair> pairs;
  for (std::size_t l = 0; l < lumps.size(); ++l)
    for (std::size_t m = 0; m < marks.size(); ++m)
      if (const double d = apart(lumps[l].p_P, marks[m].p_P); d <= rules.found_within)
        pairs.push_back({d, l, m});
  std::sort(pairs.begin(), pairs.end(), [](const Pair& a, const Pair& b) {
    return std::tie(a.distance, a.lump, a.mark) < std::tie(b.distance, b.lump, b.mark);
  });
  score->lumps.assign(lumps.size(), {});
  std::vector<bool> used(marks.size(), false), near(marks.size(), false);
  for (const Pair& pair : pairs) {
    near[pair.mark] = true;
    LumpVerdict& verdict = score->lumps[pair.lump];
    if (verdict.mark >= 0 || used[pair.mark]) continue;
    used[pair.mark] = true;
    const CaseLump& lump = lumps[pair.lump];
    const LumpMark& mark = marks[pair.mark];
    verdict = {static_cast<int>(pair.mark), pair.distance,
               mark.diameter > 0 ? mark.diameter - lump.diameter : 0,
               mark.hardness > 0 && mark.hardness == lump.hardness,
               mark.mobility > 0 && mark.mobility == lump.mobility};
    ++score->found;
  }
  score->missed = static_cast<int>(lumps.size()) - score->found;
  false_alarm->resize(marks.size());
  for (std::size_t m = 0; m < marks.size(); ++m) {
    (*false_alarm)[m] = !near[m];
    score->false_alarms += !near[m];
    score->of_normal += !near[m] && anatomyAt(rules.normal, marks[m].p_P, rules.reach) != nullptr;
    score->repeated += near[m] && !used[m];
  }
}

/// Distance of a place from the quarter of the area on these sides; 0 inside.
double fromQuadrant(const SearchArea& area, int side_x, int side_y, const Vec3& p) {
  const double x = side_x * p.x(), y = side_y * p.y();
  const double dx = std::max({-x, x - area.half_x, 0.0}), dy = std::max({-y, y - area.half_y, 0.0});
  return pinned::hypot(dx, dy);
}

/// A lump on the line between two quarters is in both.
void judgeQuadrants(const PalpationRules& rules, const std::vector<CaseLump>& lumps,
                    const std::vector<LumpMark>& marks, const std::vector<bool>& false_alarm,
                    PalpationScore* score) {
  for (const int side_x : {-1, 1}) {
    for (const int side_y : {-1, 1}) {
      const auto from = [&](const Vec3& p_P) {
        return fromQuadrant(rules.area, side_x, side_y, p_P);
      };
      bool near = false, ill = false, hit = false, wrong = false;
      for (std::size_t l = 0; l < lumps.size(); ++l) {
        near |= from(lumps[l].p_P) <= rules.found_within;
        ill |= from(lumps[l].p_P) <= 0;
        hit |= from(lumps[l].p_P) <= 0 && score->lumps[l].mark >= 0;
      }
      for (std::size_t m = 0; m < marks.size(); ++m)
        wrong |= false_alarm[m] && from(marks[m].p_P) <= 0;
      score->ill_quadrants += ill;
      score->hit_quadrants += hit;
      score->clear_quadrants += !near;
      score->wrong_quadrants += !near && wrong;
    }
  }
}

/// Each tool's time counts for itself.
void judgeForces(const PalpationRules& rules, PalpationSamples samples, PalpationScore* score) {
  double touched = 0, sum = 0, light = 0, hard = 0;
  std::array<double, 2> before{-1, -1};  // s
  for (const PalpationSample& sample : samples) {
    double& last = before[sample.tool & 1];
    const double dt = sample.t_s - last, f = sample.f_n;
    const bool first = last < 0;
    last = sample.t_s;
    if (first) continue;
    score->peak = std::max(score->peak, f);
    if (f < rules.touch) continue;
    touched += dt;
    sum += f * dt;
    light += f < rules.levels[0] ? dt : 0;
    hard += f > rules.too_hard ? dt : 0;
  }
  if (touched > 0) {
    score->mean = sum / touched;
    score->too_light = light / touched;
    score->too_hard = hard / touched;
  }
}

double closerForce(const std::vector<Press>& presses) {
  double closer = 0, search = 0;
  int closer_count = 0, search_count = 0;
  for (const Press& press : presses) {
    (press.palpating ? closer : search) += press.peak;
    ++(press.palpating ? closer_count : search_count);
  }
  return closer_count > 0 && search_count > 0 ? (closer / closer_count) / (search / search_count)
                                              : 0;
}

}  // namespace

PalpationScore scorePalpation(const PalpationRules& rules, const std::vector<CaseLump>& lumps,
                              PalpationSamples samples, const std::vector<LumpMark>& marks) {
  PalpationScore score;
  std::vector<bool> false_alarm;
  giveMarks(rules, lumps, marks, &score, &false_alarm);
  judgeQuadrants(rules, lumps, marks, false_alarm, &score);
  CoverageMap map(rules.area, rules.levels, rules.reach);
  for (const PalpationSample& sample : samples) map.add(sample);
  for (std::size_t i = 0; i < kPressureLevels; ++i)
    score.coverage[i] = map.share(static_cast<int>(i) + 1);
  score.twice = map.twice();
  std::vector<Press> presses = pressesIn(ofTool(samples, 0), rules.touch);
  score.pattern = patternOf(presses, rules.area);  // another finger goes beside the first
  for (const Press& press : pressesIn(ofTool(samples, 1), rules.touch)) presses.push_back(press);
  score.presses = static_cast<int>(presses.size());
  score.closer_force = closerForce(presses);
  judgeForces(rules, samples, &score);
  if (!samples.empty()) score.seconds = samples.back().t_s - samples.front().t_s;
  return score;
}

MarkMeaning meaningOf(std::size_t mark, const PalpationRules& rules, const PalpationScore& score,
                      const std::vector<CaseLump>& lumps, const std::vector<LumpMark>& marks) {
  const bool found = std::any_of(
      score.lumps.begin(), score.lumps.end(),
      [&](const LumpVerdict& verdict) { return verdict.mark == static_cast<int>(mark); });
  if (found) return MarkMeaning::found;
  const bool near = std::any_of(lumps.begin(), lumps.end(), [&](const CaseLump& lump) {
    return (lump.p_P - marks[mark].p_P).head<2>().norm() <= rules.found_within;
  });
  return near ? MarkMeaning::repeated : MarkMeaning::false_alarm;
}

}  // namespace palpa::assess
