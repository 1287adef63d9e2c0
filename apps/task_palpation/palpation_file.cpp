#include "apps/task_palpation/palpation_file.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "anatomy/base/error.h"
#include "anatomy/base/file_schema.h"
#include "anatomy/base/units.h"
#include "apps/station/task_sections.h"
#include "apps/task_palpation/palpation_place.h"
#include "apps/training/engine.h"

namespace palpa::task_palpation {
namespace {

double finiteIn(const JsonFile& file, const nlohmann::json& value, double low, double high) {
  if (!value.is_number() || !(value.get<double>() >= low && value.get<double>() <= high))
    file.refuse("anatomy", "holds " + value.dump() + " where a number from " +
                               std::to_string(std::lround(low)) + " to " +
                               std::to_string(std::lround(high)) + " must be");
  return value.get<double>();
}

/// "anatomy": [{"name": ..., "kind": ..., "width_mm": ..., "line_mm": [[x, y], ...]}, ...]; none of
/// it: an empty list.
const nlohmann::json& anatomyIn(const JsonFile& file) {
  static const nlohmann::json kNone = nlohmann::json::array();
  const auto all = file.json().find("anatomy");
  if (all == file.json().end()) return kNone;
  if (!all->is_array()) file.refuse("anatomy", "must be a list");
  for (const nlohmann::json& one : *all) {
    const bool named = one.is_object() && one.contains("name") && one["name"].is_string() &&
                       one.contains("kind") && one["kind"].is_string();
    if (!named || !one.contains("line_mm") || !one["line_mm"].is_array() || one["line_mm"].empty())
      file.refuse(
          "anatomy",
          "must name \"name\", \"kind\" (of the library), \"width_mm\" and \"line_mm\" of each");
  }
  return *all;
}

std::vector<assess::NormalAnatomy> normalIn(const JsonFile& file) {
  std::vector<assess::NormalAnatomy> all;
  for (const nlohmann::json& one : anatomyIn(file)) {
    assess::NormalAnatomy normal{
        one["name"].get<std::string>(),
        {},
        kMm * finiteIn(file, one.value("width_mm", nlohmann::json()), 1, 200)};
    for (const nlohmann::json& point : one["line_mm"]) {
      if (!point.is_array() || point.size() != 2)
        file.refuse("anatomy", "holds " + point.dump() + " where a point [across, away] must be");
      normal.line_P.emplace_back(kMm * finiteIn(file, point[0], -200, 200),
                                 kMm * finiteIn(file, point[1], -200, 200), 0);
    }
    all.push_back(std::move(normal));
  }
  return all;
}

}  // namespace

Scoring scoringOf(const JsonFile& file) {
  Scoring scoring;
  assess::PalpationRules& rules = scoring.rules;
  rules.area = areaOf(file);
  rules.levels = {file.number("pressure/light_N", 0.05, 20),
                  file.number("pressure/medium_N", 0.05, 20),
                  file.number("pressure/deep_N", 0.05, 20)};
  if (!(rules.levels[0] < rules.levels[1] && rules.levels[1] < rules.levels[2]))
    file.refuse("pressure", "must rise from light to deep");
  rules.too_hard = file.number("pressure/too_hard_N", 0.1, 50);
  if (rules.too_hard <= rules.levels[2])
    file.refuse("pressure/too_hard_N", "must be more than deep");
  rules.reach = kMm * file.number("scoring/reach_mm", 1, 30);
  rules.touch = file.number("scoring/touch_N", 0.02, 5);
  rules.found_within = kMm * file.number("scoring/found_within_mm", 1, 50);
  rules.normal = normalIn(file);
  scoring.standard.sensitivity = file.number("scoring/pass_sensitivity", 0, 1);
  scoring.standard.coverage = file.number("scoring/pass_coverage", 0, 1);
  if (file.has("scoring/pass_deep_coverage"))
    scoring.standard.deep_coverage = file.number("scoring/pass_deep_coverage", 0, 1);
  if (file.has("scoring/pass_false_alarms"))
    scoring.standard.false_alarms = file.number("scoring/pass_false_alarms", 0, 100);
  return scoring;
}

namespace {

std::size_t kindNamed(const JsonFile& file, const char* field, const nlohmann::json& name,
                      const station::LumpLibrary& library) {
  const auto one =
      std::find_if(library.kinds.begin(), library.kinds.end(), [&](const station::LumpKind& kind) {
        return name.is_string() && kind.name == name.get<std::string>();
      });
  if (one == library.kinds.end())
    file.refuse(field, "names " + name.dump() + ", which the library of lumps does not hold");
  return static_cast<std::size_t>(one - library.kinds.begin());
}

std::vector<std::size_t> kindsOf(const JsonFile& file, const station::LumpLibrary& library) {
  std::vector<std::size_t> kinds;
  for (const nlohmann::json& name : file.json().at("cases").value("kinds", nlohmann::json::array()))
    kinds.push_back(kindNamed(file, "cases/kinds", name, library));
  if (kinds.empty()) file.refuse("cases/kinds", "must name one lump at least");
  return kinds;
}

std::vector<double> sharesOf(const JsonFile& file) {
  std::vector<double> shares;
  double all = 0;
  for (const nlohmann::json& share :
       file.json().at("cases").value("lumps", nlohmann::json::array())) {
    if (!share.is_number() || share.get<double>() < 0)
      file.refuse("cases/lumps", "must hold probabilities");
    shares.push_back(share.get<double>());
    all += shares.back();
  }
  if (std::abs(all - 1) > 1e-6) file.refuse("cases/lumps", "must add up to 1");
  return shares;
}

/// A lump at each point of its line, as deep as it was identified.
Case piecesOf(const JsonFile& file, const std::vector<assess::NormalAnatomy>& normal,
              const station::LumpLibrary& library) {
  Case pieces;
  for (std::size_t i = 0; i < normal.size(); ++i) {
    const std::size_t kind = kindNamed(file, "anatomy", anatomyIn(file)[i]["kind"], library);
    for (const Vec3& p : normal[i].line_P)
      pieces.push_back({kind, Vec3(p.x(), p.y(), -library.kinds[kind].depth)});
  }
  return pieces;
}

/// "real_lump": {"kind": ..., "across_mm": ..., "away_mm": ..., "taken_in": 0.5}
std::optional<RealLump> realIn(const JsonFile& file, const station::LumpLibrary& library) {
  if (!file.has("real_lump")) return std::nullopt;
  RealLump real;
  real.lump.kind =
      kindNamed(file, "real_lump/kind", nlohmann::json(file.text("real_lump/kind")), library);
  real.lump.p_P = {kMm * file.number("real_lump/across_mm", -200, 200),
                   kMm * file.number("real_lump/away_mm", -200, 200),
                   -library.kinds[real.lump.kind].depth};
  real.lump.is = LumpIs::cast;
  real.taken_in = file.number("real_lump/taken_in", 0, 1);
  return real;
}

void requireFew(const JsonFile& file, const PalpationSettings& settings) {
  if (settings.cases.lumps.size() - 1 + settings.anatomy.size() + (settings.real ? 1 : 0) <=
      haptics::kMostLumps)
    return;
  file.refuse("cases/lumps", "allows more than " + std::to_string(haptics::kMostLumps) +
                                 " lumps, the points of \"anatomy\" among them");
}

/// Lumps lie wholly inside; those below a curved top along its normal.
void requireInside(const JsonFile& file, const PalpationSettings& settings) {
  const assess::SearchArea& area = settings.scoring.rules.area;
  if (2 * area.half_x > settings.size.x() || 2 * area.half_y > settings.size.y())
    file.refuse("area", "is larger than the phantom");
  const double high = leastHeight(settings.size, area);
  for (const std::size_t k : settings.cases.kinds) {
    const station::LumpKind& kind = settings.library.kinds[k];
    const double beyond = kind.diameter / 2 - settings.cases.margin;
    if (area.half_x + beyond > settings.size.x() / 2 ||
        area.half_y + beyond > settings.size.y() / 2 || kind.depth - kind.diameter / 2 < 0 ||
        kind.depth + kind.diameter / 2 > high)
      file.refuse("cases/kinds", "holds \"" + kind.name +
                                     "\", which would stick out of the phantom: its middle lies " +
                                     std::to_string(std::lround(1e3 * kind.depth)) +
                                     " mm deep, it measures " +
                                     std::to_string(std::lround(1e3 * kind.diameter)) + " mm");
  }
  for (const LumpInCase& piece : settings.anatomy) {
    const double r = settings.library.kinds[piece.kind].diameter / 2;
    if (std::abs(piece.p_P.x()) + r > settings.size.x() / 2 ||
        std::abs(piece.p_P.y()) + r > settings.size.y() / 2)
      file.refuse("anatomy", "would stick out of the phantom");
  }
  const double free_x = area.half_x - settings.cases.margin,
               free_y = area.half_y - settings.cases.margin;
  if (free_x <= 0 || free_y <= 0) file.refuse("cases/margin_mm", "leaves no room");
  const double rooms = (1 + std::floor(2 * free_x / settings.cases.apart)) *
                       (1 + std::floor(2 * free_y / settings.cases.apart));
  if (rooms < static_cast<double>(settings.cases.lumps.size()) - 1)
    file.refuse("cases/apart_mm", "leaves no room for so many lumps");
}

}  // namespace

PalpationSettings readPalpation(const std::filesystem::path& path) {
  const JsonFile file = station::readTaskFile(path);
  training::needEngine(file, training::Engine::palpation);
  needKind(file, "task_palpation", 1);
  PalpationSettings settings;
  settings.id = file.text("id");
  settings.title = file.text("title");
  settings.brief = station::briefOf(file);
  settings.size = sizeOf(file);
  settings.seen_as = seenAs(file);
  settings.library = station::readLumps(path.parent_path() / file.text("lumps"));
  settings.scoring = scoringOf(file);
  if (!file.has("cases/lumps") || !file.has("cases/kinds"))
    file.refuse("cases", "must hold \"lumps\" and \"kinds\"");
  settings.cases = {sharesOf(file), kindsOf(file, settings.library),
                    kMm * file.number("cases/apart_mm", 5, 200),
                    kMm * file.number("cases/margin_mm", 0, 200)};
  settings.anatomy = piecesOf(file, settings.scoring.rules.normal, settings.library);
  settings.real = realIn(file, settings.library);
  settings.clinical_force_N = file.number("pressure/clinical_deep_N", 0, 50);
  settings.time_limit_s = file.number("end/time_limit_s", 10, 3600);
  settings.taxonomy = station::taxonomyOf(file);
  settings.augmentations = station::readPlan(file);
  requireFew(file, settings);
  requireTouchable(file, settings.scoring.rules.area, settings.library.tip_radius);
  if (settings.real && !settings.scoring.rules.area.top.flat())
    file.refuse("real_lump", "can only be taken away below a flat top so far");
  requireInside(file, settings);
  RandomStream trial(0, "palpation.rooms");
  placeLumps(settings, settings.cases.lumps.size() - 1,
             trial);  // refused now, not in the middle of a session
  settings.source = file.json().dump();
  return settings;
}

namespace {

constexpr int kPlacesTried = 400, kBegunAnew = 200;
constexpr double kOnEdge = 1e-9;  // m

constexpr std::uint64_t kOneClearIn = 4;

/// Of every four seeds in a row (0 to 3, 4 to 7, ...) one, drawn by chance, has no lump, so that no
/// eight cases in a row are without such a case; the others make up the shares, where these have
/// less than one in four. None where the task wants none.
std::size_t countFor(std::vector<double> shares, std::uint64_t seed, double u) {
  if (shares.front() > 0) {
    RandomStream four(seed / kOneClearIn, "palpation.clear_case");
    const double drawn = four.uniform() * static_cast<double>(kOneClearIn);
    if (static_cast<std::uint64_t>(drawn) == seed % kOneClearIn) return 0;
    shares.front() = std::max(0.0, (shares.front() * kOneClearIn - 1) / (kOneClearIn - 1));
  }
  const double all = std::accumulate(shares.begin(), shares.end(), 0.0);
  std::size_t count = 0;
  for (double sum = shares.front(); count + 1 < shares.size() && u * all >= sum;
       sum += shares[count])
    ++count;
  return count;
}

bool farFromAll(const Case& others, const Vec3& p_P, double apart) {
  return std::all_of(others.begin(), others.end(), [&](const LumpInCase& other) {
    return (other.p_P - p_P).head<2>().norm() >= apart;
  });
}

}  // namespace

Case drawCase(const PalpationSettings& settings, std::uint64_t seed) {
  RandomStream random(seed, "palpation.case");
  const std::size_t count = countFor(settings.cases.lumps, seed, random.uniform());
  Case drawn = placeLumps(settings, count, random);
  if (settings.real) {
    drawn.push_back(settings.real->lump);
    const double u = RandomStream(seed, "palpation.taken").uniform();
    if (u < settings.real->taken_in) drawn.back().is = LumpIs::taken;
  }
  return drawn;
}

Case placeLumps(const PalpationSettings& settings, std::size_t count, RandomStream& random) {
  const CaseRules& rules = settings.cases;
  const double x = settings.scoring.rules.area.half_x - rules.margin,
               y = settings.scoring.rules.area.half_y - rules.margin;
  Case drawn;
  for (int tried = 0, anew = 0; drawn.size() < count; ++tried) {
    if (tried == kPlacesTried) {  // the first ones stand in the way of the rest
      if (++anew == kBegunAnew)
        throw Error("there is no room in the area for lumps so far apart",
                    "\"" + settings.id + "\", " + std::to_string(count) + " lumps",
                    "Make cases/apart_mm or the number of lumps smaller");
      drawn.clear();
      tried = 0;
    }
    const std::size_t kind = rules.kinds[std::min(
        static_cast<std::size_t>(random.uniform() * static_cast<double>(rules.kinds.size())),
        rules.kinds.size() - 1)];
    const Vec3 p_P(random.uniform(-x, x), random.uniform(-y, y),
                   -settings.library.kinds[kind].depth);
    const Case real = settings.real ? Case{settings.real->lump} : Case{};
    if (insideBy(settings.scoring.rules.area, p_P) < rules.margin - kOnEdge) continue;
    if (farFromAll(drawn, p_P, rules.apart) && farFromAll(settings.anatomy, p_P, rules.apart) &&
        farFromAll(real, p_P, rules.apart))
      drawn.push_back({kind, p_P});
  }
  return drawn;
}

std::vector<assess::CaseLump> lumpsOf(const Case& in_case, const station::LumpLibrary& library) {
  std::vector<assess::CaseLump> lumps;
  for (const LumpInCase& lump : in_case) {
    if (lump.is == LumpIs::taken) continue;
    const station::LumpKind& kind = library.kinds[lump.kind];
    lumps.push_back({lump.p_P, kind.diameter, kind.hardness, kind.mobility});
  }
  return lumps;
}

namespace {

std::array<float, 3> outwardAt(const TopShape& top, const Vec3& p_P) {
  const Eigen::Vector3f n = normalOf(top, p_P.x(), p_P.y()).cast<float>();
  return {n.x(), n.y(), n.z()};
}

}  // namespace

haptics::PlacedLumps placed(const Case& in_case, const Case& anatomy, double share,
                            const TopShape& top) {
  haptics::PlacedLumps lumps{};
  std::size_t next = 0;
  for (const Case* some : {&in_case, &anatomy})
    for (const LumpInCase& lump : *some)
      if (next < lumps.size() && lump.is != LumpIs::cast)
        lumps[next++] = {.p_T0 = pack(fromTop(top, lump.p_P)),
                         .kind = static_cast<std::uint32_t>(lump.kind) + 1,
                         .taken = lump.is == LumpIs::taken ? static_cast<float>(share) : 0,
                         .n = outwardAt(top, lump.p_P)};
  return lumps;
}

bool takesAway(const Case& in_case) {
  return std::any_of(in_case.begin(), in_case.end(),
                     [](const LumpInCase& lump) { return lump.is == LumpIs::taken; });
}

Case withoutForce(Case in_case) {
  for (LumpInCase& lump : in_case)
    if (lump.is == LumpIs::taken) lump.is = LumpIs::cast;
  return in_case;
}

}  // namespace palpa::task_palpation
