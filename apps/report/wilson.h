#pragma once

namespace palpa::report {

/// A share with its 95 % confidence interval.
struct ShareInterval {
  double share = 0, low = 0, high = 1;
};

/// Of `hits` among `of` independent tries. With p = hits / n and z = 1.96:
///   (p + z^2/2n -+ z sqrt(p (1 - p) / n + z^2/4n^2)) / (1 + z^2/n).
/// Holds for few tries and for shares near 0 and 1, where the usual p -+ z s does not. Without a try: no number, 0, 1.
/// Source: E. B. Wilson, J. Am. Stat. Assoc. 22, 1927.
ShareInterval wilson(int hits, int of);

}  // namespace palpa::report
