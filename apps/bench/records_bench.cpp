#include <algorithm>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <nlohmann/json.hpp>

#include "anatomy/base/error.h"
#include "anatomy/base/random.h"
#include "apps/assess/metrics/metric_table.h"
#include "apps/assess/needle/assess_trial.h"
#include "apps/assess/needle/paracentesis_score.h"
#include "apps/bench/bench.h"
#include "apps/bench/empty_records.h"
#include "apps/bench/timing.h"
#include "apps/os/child_process.h"
#include "apps/runtime/clock.h"

namespace palpa::bench {
namespace {

namespace fs = std::filesystem;

constexpr int kTrialsEach = 100, kTrialsASession = 10, kEvents = 12;
constexpr std::uint64_t kDrawn = 33;  // seed

/// A learner: how far the first trial is from the last one, and how good that is.
struct DrawnTrainee {
  std::string id;
  double skill = 1;
  RandomStream random;
};

std::string numbered(const char* letter, int n) {
  char text[32];
  std::snprintf(text, sizeof text, "%s%05d", letter, n);
  return text;
}

std::string uuidFrom(RandomStream& random) {
  char text[64];
  const std::uint64_t a = random.bits(), b = random.bits();
  std::snprintf(text, sizeof text, "%08x-%04x-4%03x-8%03x-%012llx", static_cast<unsigned>(a >> 32),
                static_cast<unsigned>(a >> 16 & 0xffff), static_cast<unsigned>(a & 0xfff),
                static_cast<unsigned>(b >> 52),
                static_cast<unsigned long long>(b & 0xffffffffffff));
  return text;
}

/// Sessions are three days apart, all in years that exist.
std::string dayOf(int session) {
  const int day = 3 * session;
  char text[64];
  std::snprintf(text, sizeof text, "%04d-%02d-%02dT09:00:00Z", 2027 + day / 336, 1 + day / 28 % 12,
                1 + day % 28);
  return text;
}

assess::ParacentesisValues drawnValues(DrawnTrainee& who, int trial) {
  const double ill = (0.1 + std::exp(-trial / 20.0)) / who.skill;
  const auto rarely = [&](double share, double most) {
    return who.random.uniform() < share ? std::ceil(most * who.random.uniform()) : 0.0;
  };
  assess::ParacentesisValues v;
  v.col_lung = rarely(0.25 * ill, 6);
  v.col_rib = rarely(0.7 * ill, 30);
  v.col_art = rarely(0.15 * ill, 5);
  v.col_vein = rarely(0.5 * ill, 60);
  v.phase_1 = 2 + 8 * ill * who.random.uniform();
  v.phase_2 = 300 + 1500 * ill * who.random.uniform();
  v.econ_mean = 2 + 4 * ill * who.random.uniform();
  v.econ_var = 0.5 + 9 * ill * who.random.uniform();
  v.time_ms = 1e3 * (12 + 60 * ill * (0.5 + who.random.uniform()));
  v.success = who.random.uniform() > 0.5 * ill;
  return v;
}

/// Every metric of a needle's trial, as many digits as a real one has. Those that pages judge by
/// hang together; the others are any numbers of their kind.
std::vector<record::Metric> drawnMetrics(const assess::ParacentesisValues& v,
                                         RandomStream& random) {
  const std::vector<record::Metric> known{
      {"success", v.success ? 1.0 : 0.0},
      {"time_s", 1e-3 * v.time_ms},
      {"total", assess::total(v)},
      {"col_lung", v.col_lung},
      {"col_rib", v.col_rib},
      {"col_artery", v.col_art},
      {"col_vein", v.col_vein},
      {"phase_1_mm", v.phase_1},
      {"phase_2", v.phase_2},
      {"econ_mean_mm", v.econ_mean},
      {"econ_var_mm2", v.econ_var},
      {"needle_passes", 1 + std::floor(std::abs(1.2 * random.normal()))},
      {"closest_pleura_mm", v.col_lung > 0 ? -1 : 15 * random.uniform()}};
  std::vector<record::Metric> all;
  for (const metrics::MetricDefinition& d : metrics::metricTable()) {
    if (!metrics::belongsTo(d, "needle")) continue;
    const auto found = std::find_if(known.begin(), known.end(),
                                    [&](const record::Metric& m) { return m.name == d.name; });
    const bool counts = std::string(d.unit) == "1";
    all.push_back(found != known.end() ? *found
                  : counts             ? record::Metric{d.name, std::floor(3 * random.uniform())}
                                       : record::Metric{d.name, 50 * random.uniform()});
  }
  return all;
}

record::StoredTrial drawnTrial(DrawnTrainee& who, int number, int trial) {
  const assess::ParacentesisValues v = drawnValues(who, trial);
  record::StoredTrial t;
  t.number = number;
  t.start_ns = number * 120'000'000'000;
  t.end_ns = t.start_ns + static_cast<std::int64_t>(1e6 * v.time_ms);
  t.role = "scored";
  t.seed = who.random.bits();
  t.outcome = v.success ? "success" : "time";
  t.success = v.success;
  t.metrics = drawnMetrics(v, who.random);
  t.score_json = nlohmann::json{{"COL_LUNG", v.col_lung},   {"COL_RIB", v.col_rib},
                                {"COL_ART", v.col_art},     {"COL_VEIN", v.col_vein},
                                {"PHASE_1", v.phase_1},     {"PHASE_2", v.phase_2},
                                {"ECON_MEAN", v.econ_mean}, {"ECON_VAR", v.econ_var},
                                {"TIME", v.time_ms},        {"TOTAL", assess::total(v)},
                                {"SUCCESS", v.success},     {"RULES", assess::kNewestRules}}
                     .dump();
  for (int e = 0; e < kEvents; ++e)
    t.events.push_back(
        {t.start_ns + e * runtime::kSecond, "wall", "Wall punctured: the skin and fascia", 0});
  return t;
}

/// A thousand bytes of facts, as a session has.
std::string drawnFacts(const std::string& trainee) {
  return nlohmann::json{{"operator", "novice"},
                        {"augment", false},
                        {"trainee", trainee},
                        {"side", "right"},
                        {"simulated", true},
                        {"presentation", {{"name", "practice"}, {"source", std::string(800, '.')}}}}
      .dump();
}

void addDrawn(record::RecordStore& store, int n) {
  DrawnTrainee who{numbered("B", n), 1, RandomStream(kDrawn, numbered("trainee", n))};
  who.skill = std::exp(0.3 * who.random.normal());
  store.addTrainee(
      {who.id, n % 2 ? "novice" : "experienced", "", "right", dayOf(0), dayOf(0), "", ""});
  for (int s = 0; s < kTrialsEach / kTrialsASession; ++s) {
    record::StoredSession session;
    session.uuid = uuidFrom(who.random);
    session.trainee = who.id;
    session.started_utc = dayOf(s);
    session.software = "palpa bench";
    session.task = "paracentesis";
    session.station = "virtual bench";
    session.simulated = true;
    session.evidence = "/nowhere/" + session.uuid + "/session.palpa";
    session.evidence_sha256 = std::string(64, '0');
    session.facts_json = drawnFacts(who.id);
    std::vector<record::StoredTrial> trials;
    for (int t = 1; t <= kTrialsASession; ++t)
      trials.push_back(drawnTrial(who, t, s * kTrialsASession + t));
    store.addTrials(session, trials);
  }
}

struct CommandCost {
  double seconds = 0;
  os::Spent spent;
};

/// A command of this program in a process of its own. The quickest of three: what else the computer
/// does only ever adds.
CommandCost measured(std::vector<std::string> command, const std::string& records,
                     const fs::path& folder) {
  const fs::path out = folder / "out", log = folder / "log";
  command.insert(command.end(), {"--records", records, "--out", out.string()});
  CommandCost best;
  for (int turn = 0; turn < 3; ++turn) {
    const runtime::SteadyClock clock;
    const os::Spent spent = os::runToEnd(command, log);
    const double seconds = 1e-9 * static_cast<double>(clock.now());
    if (spent.exit_code != 0)
      throw Error("failed", "palpa " + command[0] + ' ' + command[1], "Run it alone to see why");
    fs::remove_all(out);
    const double peak = std::max(best.spent.peak_MB, spent.peak_MB);
    if (turn == 0 || seconds < best.seconds) best = {seconds, spent};
    best.spent.peak_MB = peak;
  }
  return best;
}

void printMeasured(const std::string& what, const CommandCost& m, nlohmann::json params) {
  params["processor_s"] = m.spent.processor_s;
  print(what + "_seconds", m.seconds, "s", params);
  params.erase("processor_s");
  print(what + "_peak_mb", m.spent.peak_MB, "MB", params);
}

}  // namespace

void benchRecords(const RecordsBenchOptions& options) {
  EmptyRecords records(options.records);
  std::vector<int> sizes = options.trials;
  std::sort(sizes.begin(), sizes.end());
  int trainees = 0;
  for (const int trials : sizes) {
    while (trainees * kTrialsEach < trials) addDrawn(records.store, ++trainees);
    const nlohmann::json params{{"data", "simulated"},
                                {"store", records.kind()},
                                {"trials", trainees * kTrialsEach},
                                {"trainees", trainees}};
    printMeasured("cohort", measured({"report", "cohort"}, records.place, records.folder.path()),
                  params);
    printMeasured("export",
                  measured({"records", "export", "--all"}, records.place, records.folder.path()),
                  params);
  }
}

}  // namespace palpa::bench
