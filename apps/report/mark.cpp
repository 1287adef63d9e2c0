#include "apps/report/mark.h"

#include "apps/report/numbers.h"

namespace palpa::report {

std::string markPath(Tone tone, double x, double y, double r) {
  const auto at = [&](double dx, double dy) {
    return coordinate(x + dx) + ' ' + coordinate(y + dy);
  };
  if (tone == Tone::bad) {
    const double d = 1.3 * r;
    return 'M' + at(0, -d) + 'L' + at(d, 0) + 'L' + at(0, d) + 'L' + at(-d, 0) + 'Z';
  }
  if (tone == Tone::guide) {
    const double s = 0.9 * r;
    return 'M' + at(-s, -s) + 'L' + at(s, -s) + 'L' + at(s, s) + 'L' + at(-s, s) + 'Z';
  }
  const std::string arc = 'A' + coordinate(r) + ' ' + coordinate(r) + " 0 1 0 ";
  return 'M' + at(-r, 0) + arc + at(r, 0) + arc + at(-r, 0) + 'Z';
}

}  // namespace palpa::report
