#include <signal.h>
#include <sys/resource.h>

#include <csignal>
#include <map>
#include <set>

#include "anatomy/base/whole_file.h"
#include "apps/record/store/record_store.h"
#include "apps/runtime/clock.h"
#include "small_campaign.h"
#include "tests/support/setting.h"

/// Nothing is computed twice and nothing is lost, whoever computes it and whatever dies.
namespace palpa::study {
namespace {

namespace fs = std::filesystem;

/// Of each combination: 12 sessions in all. tests/cli/slurm.sh counts to 1,000.
constexpr int kSeeds = 3;
constexpr std::size_t kSessions = 4 * static_cast<std::size_t>(kSeeds);

void aMoment() { runtime::rest(std::chrono::milliseconds(2)); }

/// When each result was made.
std::map<fs::path, fs::file_time_type> agesOf(const std::vector<fs::path>& results) {
  std::map<fs::path, fs::file_time_type> ages;
  for (const fs::path& result : results)
    ages[result.filename()] = fs::last_write_time(result / "trials.csv");
  return ages;
}

bool says(const std::string& text, const std::string& words) {
  return text.find(words) != std::string::npos;
}

/// Runs it to its end in this process.
Ran ran(const CampaignOptions& options, const fs::path& printed) {
  return Runner(options, printed).wait();
}

TEST_F(SmallCampaign, GivesTheSameBytesByOneProcessByTwoAndInParts) {
  const fs::path file = comparisons(kSeeds);
  const Ran one = ran(options(file, "one"), here_ / "one.txt");
  EXPECT_EQ(one.failure, "") << one.printed;
  EXPECT_EQ(one.computed(), static_cast<int>(kSessions)) << one.printed;
  const std::string table = slurped(tableIn("one"));
  EXPECT_EQ(linesIn(table), kSessions + 1);
  EXPECT_EQ(table.find("TASK,PATIENT,OPERATOR,SETTING,USER_ID,TRIAL,SEED,"), 0u) << table;
  EXPECT_TRUE(says(table, "\nsqueeze,reference,expert,touch,SIM-expert,1,1,")) << table;
  CampaignOptions two = options(file, "two");
  two.jobs = 2;
  EXPECT_EQ(ran(two, here_ / "two.txt").failure, "");
  EXPECT_EQ(slurped(tableIn("two")), table);
  CampaignOptions part = options(file, "parts");
  part.parts = 3;
  int computed = 0;
  for (part.part = 0; part.part < 3; ++part.part) {
    const Ran some = ran(part, here_ / ("part" + std::to_string(part.part) + ".txt"));
    EXPECT_EQ(some.failure, "");
    computed += some.computed();
  }
  EXPECT_EQ(computed, static_cast<int>(kSessions));
  EXPECT_FALSE(fs::exists(tableIn("parts"))) << "a part is no whole";
  collectCampaign(options(file, "parts"));
  EXPECT_EQ(slurped(tableIn("parts")), table);
  const Ran again = ran(options(file, "one"), here_ / "again.txt");
  EXPECT_EQ(again.computed(), 0) << again.printed;
  EXPECT_EQ(slurped(tableIn("one")), table);
}

TEST_F(SmallCampaign, KilledOrInterruptedInTheMiddleGoesOnWithWhatIsMissing) {
  const fs::path file = comparisons(2);  // 8 sessions
  CampaignOptions some = options(file, "out");
  some.jobs = 2;
  std::map<fs::path, fs::file_time_type> before;
  for (const int signal : {SIGKILL, SIGTERM}) {
    const std::size_t there = resultsIn("out").size();
    Runner runner(some, here_ / "cut.txt");
    while (resultsIn("out").size() < there + 2) aMoment();
    ::kill(runner.pid(), signal);
    const Ran cut = runner.wait();  // and for its workers, who have the line to this process, too
    EXPECT_TRUE(says(cut.failure, signal == SIGKILL ? "signal KILL" : "was interrupted"))
        << cut.failure;
    EXPECT_LT(resultsIn("out").size(), 8u);
    for (const auto& [result, age] : before) EXPECT_EQ(agesOf(resultsIn("out")).at(result), age);
    before = agesOf(resultsIn("out"));
  }
  const Ran rest = ran(some, here_ / "rest.txt");
  EXPECT_EQ(rest.failure, "") << rest.printed;
  EXPECT_EQ(rest.computed(), static_cast<int>(8 - before.size()));
  const auto after = agesOf(resultsIn("out"));
  EXPECT_EQ(after.size(), 8u);
  for (const auto& [result, age] : before) EXPECT_EQ(after.at(result), age) << "computed again";
  EXPECT_EQ(linesIn(slurped(tableIn("out"))), 9u);
  EXPECT_TRUE(fs::is_empty(here_ / "out/work"));
}

TEST_F(SmallCampaign, ThatLosesAProcessNamesTheSessionAndTriesItAgain) {
  const fs::path file = comparisons(1);  // 4 sessions
  Runner runner(options(file, "out"), here_ / "first.txt");
  while (runner.workers().empty()) aMoment();
  ::kill(runner.workers().at(0), SIGSEGV);
  const Ran first = runner.wait();
  EXPECT_TRUE(says(first.failure, "1 of 4 sessions missing, 1 failed")) << first.failure;
  EXPECT_TRUE(says(first.printed,
                   "Failed: squeeze, patient reference, expert, setting touch, seed "
                   "1: its process was ended by signal SEGV"))
      << first.printed;
  EXPECT_EQ(linesIn(slurped(tableIn("out"))), 4u) << "the others' trials are there";
  const Ran second = ran(options(file, "out"), here_ / "second.txt");
  EXPECT_EQ(second.failure, "");
  EXPECT_EQ(second.computed(), 1);
  EXPECT_EQ(linesIn(slurped(tableIn("out"))), 5u);
}

TEST_F(SmallCampaign, ByTwoRunnersBesideEachOtherIsComputedOnce) {
  const fs::path file = comparisons(2);  // 8 sessions
  Runner a(options(file, "out"), here_ / "a.txt"), b(options(file, "out"), here_ / "b.txt");
  const Ran first = a.wait(), second = b.wait();
  EXPECT_EQ(first.failure, "");
  EXPECT_EQ(second.failure, "");
  EXPECT_EQ(first.computed() + second.computed(), 8) << first.printed << second.printed;
  EXPECT_EQ(resultsIn("out").size(), 8u);
  EXPECT_TRUE(fs::is_empty(here_ / "out/work"));
}

TEST_F(SmallCampaign, WithoutHopeStopsEarly) {
  nlohmann::json skill = nlohmann::json::parse(slurped(kAssets / "operators/expert.json"));
  put("clumsy.json", skill);  // of a needle: nobody can squeeze with it
  nlohmann::json campaign = nlohmann::json::parse(slurped(comparisons(5)));
  campaign["operators"] = {"clumsy.json"};
  campaign.erase("settings");
  campaign["seeds"]["count"] = 30;
  const Ran all = ran(options(put("campaign.json", campaign), "out"), here_ / "out.txt");
  EXPECT_TRUE(says(all.failure, "30 of 30 sessions missing, 10 failed")) << all.failure;
  EXPECT_TRUE(says(all.printed, "clumsy.json")) << all.printed;
}

TEST_F(SmallCampaign, SaysAtOnceThatTheTrackingModelDoesNotKnowTheStation) {
  nlohmann::json station =
      nlohmann::json::parse(slurped(kAssets / "stations/palpation_bench.json"));
  station["twin"]["camera_distance_mm"] = 1500;
  put("far.json", station);
  nlohmann::json campaign = nlohmann::json::parse(slurped(comparisons(1)));
  campaign["station"] = "far.json";
  campaign["settings"] = {{{"name", "model"}, {"tracking", "model"}}};
  const Ran all = ran(options(put("campaign.json", campaign), "out"), here_ / "out.txt");
  EXPECT_TRUE(says(all.failure, "far.json, twin/camera_distance_mm")) << all.failure;
  EXPECT_TRUE(resultsIn("out").empty());
}

/// Files of this process and of those that it starts, while it lives.
class NoRoom {
 public:
  explicit NoRoom(rlim_t bytes) {
    getrlimit(RLIMIT_FSIZE, &before_);
    const rlimit little{bytes, before_.rlim_max};
    handler_ = std::signal(SIGXFSZ, SIG_IGN);
    setrlimit(RLIMIT_FSIZE, &little);
  }
  ~NoRoom() {
    setrlimit(RLIMIT_FSIZE, &before_);
    std::signal(SIGXFSZ, handler_);
  }

 private:
  rlimit before_{};
  void (*handler_)(int) = nullptr;
};

TEST_F(SmallCampaign, WithoutRoomKeepsOfFailedSessionsWhatTheyPrinted_AndGoesOnWhenThereIsSome) {
  const fs::path file = comparisons(1);
  {
    const NoRoom here(200'000);
    const Ran none = ran(options(file, "out"), here_ / "none.txt");
    EXPECT_TRUE(says(none.failure, "4 of 4 sessions missing, 4 failed")) << none.failure;
  }
  std::size_t printed = 0;
  for (const auto& entry : fs::recursive_directory_iterator(here_ / "out/work")) {
    if (!entry.is_regular_file() || entry.path().extension() == ".lock") continue;
    EXPECT_EQ(entry.path().filename(), "output.txt");
    ++printed;
  }
  EXPECT_EQ(printed, 4u);
  EXPECT_EQ(ran(options(file, "out"), here_ / "some.txt").computed(), 4);
  EXPECT_TRUE(fs::is_empty(here_ / "out/work"));
}

std::size_t trialsIn(const fs::path& records) {
  record::RecordStore store(records.string());
  std::set<std::string> sessions;
  const auto trials = store.trials({.simulated = 1});
  for (const auto& t : trials) {
    sessions.insert(t.session.uuid);
    EXPECT_TRUE(t.session.trainee == "SIM-expert" || t.session.trainee == "SIM-novice");
  }
  EXPECT_EQ(sessions.size(), trials.size());
  return trials.size();
}

TEST_F(SmallCampaign, BringsEveryTrialIntoTheRecordsOnce) {
  const test::Setting state("XDG_STATE_HOME", (here_ / "state").c_str());
  const fs::path file = comparisons(1);  // 4 sessions
  CampaignOptions kept = options(file, "out");
  kept.records = (here_ / "records.sqlite").string();
  kept.keeps = CampaignKeeps::evidence;
  kept.jobs = 2;
  EXPECT_EQ(ran(kept, here_ / "first.txt").failure, "");
  EXPECT_EQ(trialsIn(kept.records), 4u);
  EXPECT_EQ(ran(kept, here_ / "again.txt").failure, "");
  EXPECT_EQ(trialsIn(kept.records), 4u);
  fs::remove_all(resultsIn("out").front());  // computed anew it is still the same session
  const Ran anew = ran(kept, here_ / "anew.txt");
  EXPECT_EQ(anew.failure, "");
  EXPECT_EQ(anew.computed(), 1);
  EXPECT_EQ(trialsIn(kept.records), 4u);
  EXPECT_FALSE(fs::exists(here_ / "state/palpa/begun")) << "none is left for palpa finish";
}

TEST_F(SmallCampaign, KeepsOfASessionWhatWasAskedFor) {
  struct Step {
    CampaignKeeps keeps;
    int computed;
    std::set<std::string> files;
  };
  const Step steps[]{{CampaignKeeps::table, 4, {"trials.csv"}},
                     {CampaignKeeps::evidence, 4, {"session.palpa", "trials.csv"}},
                     {CampaignKeeps::reports, 4, {"report.html", "session.palpa", "trials.csv"}},
                     {CampaignKeeps::table, 0, {"report.html", "session.palpa", "trials.csv"}}};
  CampaignOptions o = options(comparisons(1), "out");
  for (const Step& step : steps) {
    o.keeps = step.keeps;
    fs::remove(here_ / "printed.txt");
    EXPECT_EQ(ran(o, here_ / "printed.txt").computed(), step.computed);
    for (const fs::path& result : resultsIn("out")) {
      std::set<std::string> there;
      for (const fs::path& file : entriesOf(result)) there.insert(file.filename().string());
      EXPECT_EQ(there, step.files) << result;
    }
  }
}

}  // namespace
}  // namespace palpa::study
