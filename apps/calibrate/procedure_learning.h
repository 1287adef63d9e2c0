#pragma once

#include <vector>

#include "apps/calibrate/subtask_recordings.h"
#include "calibration/parts/agreement.h"
#include "calibration/parts/interactive_procedures.h"

/// Recordings beside the library of interactive procedures: what their labels say in its words, a
/// library made from them, how far what is matched agrees. Pure but for the recordings.
namespace palpa::calibrate {

inline constexpr int kNoProcedure = -1;

/// Procedure that a step's label means; kNoProcedure where the label does not say what the hand
/// does, or the library has no rule for it.
int procedureOf(const calibration::ProcedureLibrary& library, const SubtaskRecordings& recordings,
                int label, int part);
/// Of every step of a sequence.
std::vector<int> proceduresOf(const calibration::ProcedureLibrary& library,
                              const SubtaskRecordings& recordings, const SubtaskSequence& sequence);

/// The library with profiles and durations from recordings, each task's steps by its own rules. A
/// procedure that no label means keeps the profiles that were written. Same recordings, same bits.
/// Throws Error where no label means anything.
calibration::ProcedureLibrary learnedFrom(const calibration::ProcedureLibrary& written,
                                          const std::vector<SubtaskRecordings>& recordings,
                                          std::uint64_t seed);

/// Of one procedure, in steps.
struct ProcedureCount {
  int labelled = 0, matched = 0, both = 0;
  double recall() const { return labelled > 0 ? 1.0 * both / labelled : 0; }
  double precision() const { return matched > 0 ? 1.0 * both / matched : 0; }
};

/// Matched beside labelled, of the steps whose label says what the hand does. Names are names: no
/// matching is sought that suits, so that kappa is Cohen's own.
struct ProcedureAgreement {
  int steps = 0;          ///< all
  int judged = 0;         ///< whose label means a procedure
  Eigen::MatrixXi table;  ///< steps judged: labelled (rows), matched (columns)
  double kappa = 0;
  /// Of the steps judged; where all labels mean one procedure, this says more than kappa
  double agreed() const { return judged > 0 ? 1.0 * table.trace() / judged : 0; }
  bool oneProcedure() const { return (table.rowwise().sum().array() > 0).count() == 1; }
  std::vector<ProcedureCount> each;  ///< as the library counts them
};
ProcedureAgreement procedureAgreement(std::size_t procedures,
                                      const std::vector<std::vector<int>>& matched,
                                      const std::vector<std::vector<int>>& labelled);

}  // namespace palpa::calibrate
