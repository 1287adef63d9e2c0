#pragma once

#include <Eigen/Core>
#include <vector>

/// How far two labelings of the same steps agree: found states beside hand-written subtasks. Pure
/// functions, no units but steps.
namespace palpa::calibration {

/// How often a label of the one meets a label of the other.
struct Contingency {
  std::vector<int> one, other;  ///< the labels that occur, rising: rows and columns
  Eigen::MatrixXi counts;       ///< steps
};

/// Throws Error for no steps and for labelings of unlike length. Labels may be any integers. Trials
/// may be joined end to end.
Contingency contingencyOf(const std::vector<int>& one, const std::vector<int>& other);

/// Which label of the other (its column) each label of the one (row) is, one to one, so that most
/// steps agree; -1: none is left for it. Of matchings that agree in as many steps, one by which
/// chance would agree in the fewest, always the same. Kuhn 1955 (Hungarian method).
std::vector<int> bestMatching(const Contingency& table);

/// Cohen 1960, after bestMatching: kappa = (p_o - p_e) / (1 - p_e), p_o the share of steps in
/// matched pairs, p_e the sum over matched pairs of the product of their shares. A label without
/// partner only disagrees. 1: alike but for names; 0: no better than chance, which is so when one
/// of them has a single label and the other more. Both with a single label: 1. The matching is
/// chosen in favour of agreement: random labels lie above 0 by about K / sqrt(steps).
double cohensKappa(const Contingency& table);

/// Cohen 1960 for labels that have the same names in both, in the same order: rows and columns are
/// the same labels, and no matching is sought. p_o the share on the diagonal, p_e the sum of the
/// products of row and column shares. Throws Error for no steps and a table that is not square.
double kappaByName(const Eigen::MatrixXi& counts);

/// Hubert and Arabie 1985: (sum C(n_ij, 2) - E) / ((A + B) / 2 - E), A = sum C(n_i., 2), B = sum
/// C(n_.j, 2), E = A B / C(n, 2). 1: alike but for names; 0 in the mean by chance; can be below.
/// Needs no matching: a subtask found in two parts costs only that. Both with a single label, and
/// both with a label for each step: 1, though chance does as well.
double adjustedRandIndex(const Contingency& table);

/// The steps at which a new label begins, rising; the first step is none.
std::vector<int> boundariesOf(const std::vector<int>& labels);

/// Boundaries of several trials add up: += the answers of each. Trials joined end to end would have
/// invalid boundaries.
struct BoundaryAgreement {
  int met = 0;               ///< pairs within tolerance
  int found = 0;             ///< boundaries of the one that is judged
  int expected = 0;          ///< boundaries of the other, taken for true
  double precision() const;  ///< met / found; 1 where none is found: nothing is wrong
  double recall() const;     ///< met / expected; 1 where none is expected: nothing is missed
  double f() const;          ///< 2 P R / (P + R); 0 where both are 0
  BoundaryAgreement& operator+=(const BoundaryAgreement& more);
};

/// A boundary is met by one within +-tolerance steps of it, one to one and as many as can be: three
/// boundaries about a true one are one right and two wrong. Throws Error for no steps, labelings of
/// unlike length, a negative tolerance.
BoundaryAgreement boundaryAgreement(const std::vector<int>& found, const std::vector<int>& expected,
                                    int tolerance);

}  // namespace palpa::calibration
