#include "apps/session/whole_session.h"

#include <optional>

#include "anatomy/base/error.h"
#include "apps/os/real_time.h"
#include "apps/os/signals.h"
#include "apps/session/comparison_session.h"
#include "apps/session/finish_session.h"
#include "apps/session/needle_session.h"
#include "apps/session/output_folder.h"
#include "apps/session/palpation_session.h"
#include "apps/session/pulse_session.h"
#include "apps/session/search_session.h"
#include "apps/session/session_records.h"

namespace palpa::session {

using training::Engine;

namespace {

/// `hold` leaves all of a session in its folder; true: somebody ended it early.
template <class Hold>
SessionLeft heldIn(const SessionOptions& options, Hold hold) {
  if (!options.fast) {  // it may last for hours
    os::giveLargeMemoryBack();
    os::keepStacksSmall();
  }
  OutputFolder output(options.out, options.command);
  const os::InterruptNote interrupt;  // whatever comes now, report and table are written
  const std::filesystem::path& folder = output.path();
  try {
    std::optional<BegunSession> begun;
    if (options.noted) begun.emplace(folder);
    const bool quit = hold(folder);
    output.keep();
    deliverSession(options, folder);
    return {folder, quit};
  } catch (const std::exception& e) {
    if (options.noted && !output.hasOlderSession()) reportFailed(folder, e.what());
    throw;
  }
}

/// `what`: of the session, as in "does not show a search yet".
void needDesktop(const SessionOptions& options, const std::string& what) {
  if (options.headset)
    throw UsageError("does not show " + what + " yet", "--display openxr",
                     "Choose window or offscreen");
}

void needDeviceFor(const SessionOptions& options, bool on_bench) {
  if (options.who == OperatorKind::person && on_bench)
    throw UsageError(
        "cannot be felt with a mouse", "--operator person",
        "Give a station with a haptic device (--station), or take --operator expert or novice");
}

SessionLeft heldComparison(const SessionOptions& options, const ComparisonWorld& world) {
  return heldIn(options, [&](const std::filesystem::path& folder) {
    const ComparisonRun run = runComparison(options, world, folder);
    writeComparisonOutcome(options, world, run, folder);
    return run.quit;
  });
}

}  // namespace

SessionLeft holdNeedleSession(SessionOptions options) {
  settle(options);
  if (!options.quiet) offerUnfinished();
  NeedleWorld world(options);
  settleOperator(options, world.station);
  checkTrainee(options);
  meetOthers(options, isSimulated(options, world), world.task.source);
  sayTaken(options, steadyingFacts(options, world.task.augmentations, world.station));
  return heldIn(options, [&](const std::filesystem::path& folder) {
    if (options.who == OperatorKind::person && options.demonstration)
      showDemonstration(options, world, folder);
    const SessionResult result = runNeedleSession(options, world, folder);
    writeOutcome(options, world, result, folder);
    return result.quit;
  });
}

SessionLeft holdPalpation(SessionOptions options) {
  settle(options);
  if (!options.quiet) offerUnfinished();
  needDesktop(options, "palpation");
  const PalpationWorld world(options);
  settleOperator(options, world.station);
  world.checkFingers(options);
  checkTrainee(options);
  meetOthers(options, world.head(options).simulated, world.task.source);
  sayTaken(options, world.takenFacts(options));
  return heldIn(options, [&](const std::filesystem::path& folder) {
    const PalpationRun run = runPalpation(options, world, folder);
    writePalpationOutcome(options, world, run, folder);
    return run.quit;
  });
}

SessionLeft holdSqueeze(SessionOptions options) {
  settle(options);
  if (!options.quiet) offerUnfinished();
  if (!isSimulated(options.who))
    throw UsageError("cannot hold something with one device", "--operator",
                     "So far, two devices can only be simulated: --operator expert or novice");
  needDesktop(options, "squeezing");
  const SqueezeWorld world(options);
  checkTrainee(options);
  meetOthers(options, world.head(options).simulated, world.task.source);
  return heldComparison(options, world);
}

SessionLeft holdSearch(SessionOptions options) {
  settle(options);
  if (!options.quiet) offerUnfinished();
  needDesktop(options, "a search");
  const SearchWorld world(options);
  settleOperator(options, world.station);
  needDeviceFor(options, world.onBench());
  checkTrainee(options);
  meetOthers(options, world.head(options).simulated, world.task.source);
  return heldIn(options, [&](const std::filesystem::path& folder) {
    const SearchRun run = runSearch(options, world, folder);
    writeSearchOutcome(options, world, run, folder);
    return run.quit;
  });
}

SessionLeft holdFriction(SessionOptions options) {
  settle(options);
  if (!options.quiet) offerUnfinished();
  needDesktop(options, "friction");
  const FrictionWorld world(options);
  settleOperator(options, world.station);
  needDeviceFor(options, world.onBench());
  checkTrainee(options);
  meetOthers(options, world.head(options).simulated, world.task.source);
  return heldComparison(options, world);
}

SessionLeft holdPulse(SessionOptions options) {
  settle(options);
  if (!options.quiet) offerUnfinished();
  if (options.headset)
    throw UsageError("does not show a pulse yet", "--display openxr", "Choose window or offscreen");
  const PulseWorld world(options);
  settleOperator(options, world.station);
  if (options.who == OperatorKind::person && world.onBench())
    throw UsageError(
        "cannot be felt with a mouse", "--operator person",
        "Give a station with a haptic device (--station), or take --operator expert or novice");
  checkTrainee(options);
  meetOthers(options, world.head(options).simulated, world.task.source);
  return heldIn(options, [&](const std::filesystem::path& folder) {
    const PulseRun run = runPulse(options, world, folder);
    writePulseOutcome(options, world, run, folder);
    return run.quit;
  });
}

SessionLeft holdSession(Engine engine, SessionOptions options) {
  switch (engine) {
    case Engine::palpation:
      return holdPalpation(std::move(options));
    case Engine::search:
      return holdSearch(std::move(options));
    case Engine::squeeze:
      return holdSqueeze(std::move(options));
    case Engine::friction:
      return holdFriction(std::move(options));
    case Engine::pulse:
      return holdPulse(std::move(options));
    case Engine::needle:
      break;
  }
  return holdNeedleSession(std::move(options));
}

}  // namespace palpa::session
