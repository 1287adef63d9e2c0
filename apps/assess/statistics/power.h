#pragma once

#include <cstdint>

namespace palpa::statistics {

enum class Tails { one, two };

/// Chance that a pooled t-test finds a true difference of `effect` standard deviations between two
/// groups of n_a and n_b subjects, each independent; noncentral t. Source: Cohen 1988. One tail: in
/// the effect's direction. Throws Error for fewer than two subjects or a level outside (0, 1).
double powerOfTwoGroups(double effect, double n_a, double n_b, double level = 0.05,
                        Tails tails = Tails::two);

/// The same for pairs whose differences have this effect.
double powerOfPairs(double effect, double n, double level = 0.05, Tails tails = Tails::two);

/// Chance that two one-sided tests show pairs without any true difference to be equivalent; the
/// margin in standard deviations of the differences. 1 - 2 times the chance that one of the tests
/// fails, which is a lower bound: Phillips, J. Pharmacokinet. Biopharm. 18, 1990. Throws Error for
/// fewer than two pairs.
double powerOfEquivalence(double margin, double n, double level = 0.05);
/// Fewest pairs for this power. Throws Error for a margin that is not positive, and as below.
int pairsForEquivalence(double margin, double power, double level = 0.05);

/// Fewest subjects in each of two groups for this power. Throws Error for an effect of 0, a power
/// not between the level and 1, and where more than a million would be needed.
int subjectsPerGroup(double effect, double power, double level = 0.05, Tails tails = Tails::two);

/// Fewest in each of two groups to tell two rates of success from each other, by Cohen's h = 2 asin
/// sqrt(p1) - 2 asin sqrt(p2). Throws Error as above.
int subjectsPerGroupForRates(double rate_a, double rate_b, double power, double level = 0.05,
                             Tails tails = Tails::two);

}  // namespace palpa::statistics
