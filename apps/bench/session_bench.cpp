#include "apps/bench/bench.h"

#include <cstdlib>
#include <map>
#include <string>

#include "apps/bench/timing.h"
#include "apps/os/file_access.h"
#include "apps/os/system_time.h"
#include "apps/session/needle_session.h"
#include "apps/session/needle_world.h"

namespace palpa::bench {
namespace {

using session::SessionCost;

constexpr double kSecond = 1e9;  // ns

session::SessionOptions sessionOptions(const SessionBenchOptions& options, int trials) {
  session::SessionOptions session;
  session.who = session::OperatorKind::expert;
  session.fast = session.quiet = true;
  session.no_views = !options.views;
  session.display = scene::Display::offscreen;
  session.seed = options.seed;
  session.trials = trials;
  return session;
}

/// From its files to its last tick. Returns the session's time, s; `cost->started_ns` is then that
/// of a program that does nothing else: what `loading_ns` took before its main function, and this.
double hold(session::SessionOptions options, std::int64_t loading_ns, SessionCost* cost) {
  const std::int64_t before_ns = os::processorTime_ns();
  const os::TemporaryFolder folder("palpa-bench-");
  session::settle(options);
  session::NeedleWorld world(options);
  const double session_s =
      session::runNeedleSession(options, world, folder.path(), cost).simulated_s;
  cost->started_ns += loading_ns - before_ns;
  return session_s;
}

/// In the order of the words.
std::map<std::string, double> sharesOf(const SessionCost& cost) {
  const auto all = static_cast<double>(cost.run_ns);
  std::map<std::string, double> shares;
  std::int64_t steps_ns = 0;
  for (const auto& [name, ns] : cost.steps) {
    shares[name] = static_cast<double>(ns) / all;
    steps_ns += ns;
  }
  shares["drawing"] = static_cast<double>(cost.drawing_ns) / all;
  shares["tracking"] = static_cast<double>(cost.run_ns - cost.thread_ns - cost.drawing_ns) / all;
  shares["rest"] = static_cast<double>(cost.thread_ns - steps_ns) / all;
  return shares;
}

}  // namespace

void benchSession(const SessionBenchOptions& options) {
  const std::int64_t loading_ns = os::processorTime_ns();
  nlohmann::json params{{"data", "simulated"},
                        {"tracking", "images"},
                        {"views", options.views},
                        {"seed", options.seed}};
  const auto started = [&](bool cached, const SessionCost& cost) {
    params["cached"] = cached;
    print("start_seconds", static_cast<double>(cost.started_ns) / kSecond, "s", params);
  };
  {
    const char* const before = std::getenv("PALPA_CACHE");
    const std::string folder = before ? before : "";
    setenv("PALPA_CACHE", "off", 1);
    SessionCost cost;
    hold(sessionOptions(options, 1), loading_ns, &cost);
    started(false, cost);
    before ? setenv("PALPA_CACHE", folder.c_str(), 1) : unsetenv("PALPA_CACHE");
  }
  session::NeedleWorld(sessionOptions(options, 1));  // keeps the patient
  SessionCost plain, measured;
  const double session_s = hold(sessionOptions(options, options.trials), loading_ns, &plain);
  started(true, plain);
  params["trials"] = options.trials;
  print("times_real_time", session_s * kSecond / static_cast<double>(plain.run_ns), "1", params);
  measured.by_stage = true;
  hold(sessionOptions(options, options.trials), loading_ns, &measured);
  for (const auto& [stage, share] : sharesOf(measured)) {
    params["stage"] = stage;
    print("stage_share", share, "1", params);
  }
}

}  // namespace palpa::bench
