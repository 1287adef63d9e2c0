#include "apps/bench/bench.h"

#include <cstdlib>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "apps/bench/timing.h"
#include "apps/os/file_access.h"
#include "apps/os/system_time.h"
#include "apps/session/needle_session.h"
#include "apps/session/needle_world.h"

namespace palpa::bench {
namespace {

using session::SessionCost;

constexpr double kSecond = 1e9;  // ns
constexpr const char *kImages = "images", *kModel = "model";

session::SessionOptions sessionOptions(const SessionBenchOptions& options, int trials,
                                       const std::string& tracking) {
  session::SessionOptions session;
  session.who = session::OperatorKind::expert;
  session.fast = session.quiet = true;
  session.no_views = !options.views;
  session.tracking = tracking == kModel ? session::Tracking::model : session::Tracking::images;
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

/// In the order of the words. A model works in the camera's step: nothing is beside the thread.
std::map<std::string, double> sharesOf(const SessionCost& cost, const std::string& tracking) {
  const auto all = static_cast<double>(cost.run_ns);
  std::map<std::string, double> shares;
  std::int64_t steps_ns = 0;
  for (const auto& [name, ns] : cost.steps) {
    shares[name] = static_cast<double>(ns) / all;
    steps_ns += ns;
  }
  const bool beside = tracking == kImages;
  shares["rest"] = static_cast<double>((beside ? cost.thread_ns : cost.run_ns) - steps_ns) / all;
  if (!beside) return shares;
  shares["drawing"] = static_cast<double>(cost.drawing_ns) / all;
  shares["tracking"] = static_cast<double>(cost.run_ns - cost.thread_ns - cost.drawing_ns) / all;
  return shares;
}

/// "start_seconds"; `params->cached` then says which start it was.
void printStart(bool cached, const SessionCost& cost, nlohmann::json* params) {
  (*params)["cached"] = cached;
  print("start_seconds", static_cast<double>(cost.started_ns) / kSecond, "s", *params);
}

/// Where built patients are kept, while it lives.
class Cache {
 public:
  explicit Cache(const std::string& place) {
    if (const char* const before = std::getenv(kVariable)) before_ = before;
    setenv(kVariable, place.c_str(), 1);
  }
  Cache(const Cache&) = delete;
  Cache& operator=(const Cache&) = delete;
  ~Cache() { before_ ? setenv(kVariable, before_->c_str(), 1) : unsetenv(kVariable); }

 private:
  static constexpr const char* kVariable = "PALPA_CACHE";
  std::optional<std::string> before_;
};

void benchBuiltPatient(const session::SessionOptions& options, std::int64_t loading_ns,
                       nlohmann::json* params) {
  const Cache none("off");
  SessionCost cost;
  hold(options, loading_ns, &cost);
  printStart(false, cost, params);
}

void benchKeptPatient(const session::SessionOptions& options, std::int64_t loading_ns,
                      nlohmann::json params) {
  SessionCost plain, measured;
  const double session_s = hold(options, loading_ns, &plain);
  printStart(true, plain, &params);
  params["trials"] = options.trials;
  print("times_real_time", session_s * kSecond / static_cast<double>(plain.run_ns), "1", params);
  measured.by_stage = true;
  hold(options, loading_ns, &measured);
  for (const auto& [stage, share] : sharesOf(measured, params["tracking"])) {
    params["stage"] = stage;
    print("stage_share", share, "1", params);
  }
}

}  // namespace

void benchSession(const SessionBenchOptions& options) {
  const std::int64_t loading_ns = os::processorTime_ns();
  std::vector<std::string> trackings{options.tracking};
  if (options.tracking.empty() && options.views) trackings = {kImages};
  if (options.tracking.empty() && !options.views) trackings = {kImages, kModel};
  nlohmann::json params{{"data", "simulated"},
                        {"tracking", trackings.front()},
                        {"views", options.views},
                        {"seed", options.seed}};
  benchBuiltPatient(sessionOptions(options, 1, trackings.front()), loading_ns, &params);
  const os::TemporaryFolder kept("palpa-bench-");
  const Cache here(kept.path().string());
  SessionCost none;
  hold(sessionOptions(options, 1, trackings.front()), loading_ns, &none);  // keeps the patient
  for (const std::string& tracking : trackings) {
    params["tracking"] = tracking;
    benchKeptPatient(sessionOptions(options, options.trials, tracking), loading_ns, params);
  }
}

}  // namespace palpa::bench
