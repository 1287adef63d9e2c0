#include <algorithm>

#include "anatomy/geometry/error.h"
#include "apps/task_palpation/palpation_file.h"

namespace palpa::task_palpation {
namespace {

constexpr int kPlacesTried = 400, kBegunAnew = 200;

std::size_t countOf(const std::vector<double>& shares, double u) {
  std::size_t count = 0;
  for (double sum = shares.front(); count + 1 < shares.size() && u >= sum; sum += shares[count])
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
  runtime::RandomStream random(seed, "palpation.case");
  const std::size_t count = countOf(settings.cases.lumps, random.uniform());
  return placeLumps(settings, count, random);
}

Case placeLumps(const PalpationSettings& settings, std::size_t count,
                runtime::RandomStream& random) {
  const CaseRules& rules = settings.cases;
  const double x = settings.scoring.rules.area.half_x - rules.margin,
               y = settings.scoring.rules.area.half_y - rules.margin;
  Case drawn;
  for (int tried = 0, anew = 0; drawn.size() < count; ++tried) {
    if (tried == kPlacesTried) {  // the first ones stand in the way of the rest
      if (++anew == kBegunAnew)
        throw Error("lumps so far apart find no room in the area",
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
    if (farFromAll(drawn, p_P, rules.apart) && farFromAll(settings.anatomy, p_P, rules.apart))
      drawn.push_back({kind, p_P});
  }
  return drawn;
}

std::vector<assess::CaseLump> lumpsOf(const Case& in_case, const station::LumpLibrary& library) {
  std::vector<assess::CaseLump> lumps;
  for (const LumpInCase& lump : in_case) {
    const station::LumpKind& kind = library.kinds[lump.kind];
    lumps.push_back({lump.p_P, kind.diameter, kind.hardness, kind.mobility});
  }
  return lumps;
}

haptics::PlacedLumps placed(const Case& in_case, const Case& anatomy) {
  haptics::PlacedLumps lumps{};
  std::size_t next = 0;
  for (const Case* some : {&in_case, &anatomy})
    for (const LumpInCase& lump : *some)
      if (next < lumps.size())
        lumps[next++] = {pack(lump.p_P), static_cast<std::uint32_t>(lump.kind) + 1, 0};
  return lumps;
}

}  // namespace palpa::task_palpation
