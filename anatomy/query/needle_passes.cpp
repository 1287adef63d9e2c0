#include "anatomy/query/needle_passes.h"

#include <algorithm>

namespace palpa::anatomy {
namespace {

bool before(const NeedlePass& a, const NeedlePass& b) {
  return a.enter < b.enter || (a.enter == b.enter && a.surface < b.surface);
}

void insert(const NeedlePass& pass, NeedlePasses* passes) {
  if (passes->count == NeedlePasses::kMost) {
    passes->lost = true;
    return;
  }
  int at = passes->count++;
  for (; at > 0 && before(pass, passes->pass[at - 1]); --at)
    passes->pass[at] = passes->pass[at - 1];
  passes->pass[at] = pass;
}

}  // namespace

double NeedlePasses::depth(Organ organ) const {
  const auto first =
      std::find_if(begin(), end(), [organ](const NeedlePass& p) { return p.organ == organ; });
  return first == end() ? 0 : length - first->enter;
}

void addPasses(std::span<TriangleTree::Crossing> crossings, Organ organ, int surface,
               NeedlePasses* passes) {
  std::sort(crossings.begin(), crossings.end(), [](const auto& a, const auto& b) {
    return a.s < b.s || (a.s == b.s && a.entering > b.entering);
  });
  // The surface may meet itself, or touch: a level counts how deep inside the needle is.
  int level = 0, least = 0;
  for (const auto& c : crossings) least = std::min(least, level += c.entering ? 1 : -1);
  level = -least;
  NeedlePass open{organ, surface, 0, 0, Vec3::Zero(), Vec3::Zero(), true, false};
  for (const auto& c : crossings) {
    const int now = level + (c.entering ? 1 : -1);
    if (level == 0) {
      open.enter = c.s;
      open.n_enter_A = c.normal;
      open.starts_inside = false;
    } else if (now == 0) {
      open.leave = c.s;
      open.n_leave_A = c.normal;
      insert(open, passes);
    }
    level = now;
  }
  if (level == 0) return;
  open.leave = passes->length;
  open.n_leave_A = Vec3::Zero();
  open.ends_inside = true;
  insert(open, passes);
}

void addWhole(Organ organ, int surface, NeedlePasses* passes) {
  insert({organ, surface, 0, passes->length, Vec3::Zero(), Vec3::Zero(), true, true}, passes);
}

}  // namespace palpa::anatomy
