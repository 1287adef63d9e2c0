#include "small_campaign.h"

#include <algorithm>
#include <fstream>
#include <sstream>

#include "anatomy/base/whole_file.h"

namespace palpa::study {

namespace fs = std::filesystem;
using nlohmann::json;

constexpr std::int64_t kLook_ns = 1'000'000'000;

std::string slurped(const fs::path& file) { return readWhole(file).value_or(""); }

std::size_t linesIn(const std::string& text) {
  return static_cast<std::size_t>(std::count(text.begin(), text.end(), '\n'));
}

SmallCampaign::SmallCampaign()
    : here_(std::string("campaign-") +
            testing::UnitTest::GetInstance()->current_test_info()->name()) {
  json station = json::parse(slurped(kAssets / "stations/palpation_bench.json"));
  station["camera"]["rate_Hz"] = 1;  // to draw and read pictures is most of a session's computing
  put("station.json", station);
}

fs::path SmallCampaign::put(const std::string& name, const json& file) const {
  fs::path path = here_ / name;
  fs::create_directories(path.parent_path());
  std::ofstream(path, std::ios::binary) << file.dump(1);
  return path;
}

fs::path SmallCampaign::comparisons(int seeds) const {
  return put("campaign.json",
             {{"version", 1},
              {"id", "comparisons"},
              {"title", "Comparisons"},
              {"tasks", {(kAssets / "tasks/squeeze.json").string()}},
              {"station", "station.json"},
              {"operators", {"expert", "novice"}},
              {"seeds", {{"from", 1}, {"count", seeds}}},
              {"settings",
               {{{"name", "touch"}, {"tracking", "model"}},
                {{"name", "no_touch"}, {"force_feedback", false}, {"tracking", "model"}}}}});
}

CampaignOptions SmallCampaign::options(const fs::path& file, const std::string& out) const {
  CampaignOptions o;
  o.file = file.string();
  o.out = (here_ / out).string();
  o.jobs = 1;
  o.keeps = CampaignKeeps::table;
  o.quiet = true;
  return o;
}

std::vector<fs::path> SmallCampaign::resultsIn(const std::string& out) const {
  return entriesOf(here_ / out / "results");
}

int Ran::computed() const {
  const std::size_t end = printed.find(" computed now");
  if (end == std::string::npos) return -1;
  return std::stoi(printed.substr(printed.rfind(' ', end - 1) + 1));
}

Runner::Runner(const CampaignOptions& options, const fs::path& printed)
    : printed_(printed), pool_(1) {
  pool_.start(0, [options, printed](const os::Report& report) {
    std::string pid;
    std::ifstream("/proc/self/stat") >> pid;
    report(pid);
    os::sendOutputTo(printed);
    runCampaign(options);
  });
  std::vector<os::WorkerNews> news;
  while (news.empty()) news = pool_.await(kLook_ns);
  pid_ = std::stoi(news.front().lines.at(0));
}

std::vector<int> Runner::workers() const {
  std::vector<int> children;
  std::istringstream list(
      slurped("/proc/" + std::to_string(pid_) + "/task/" + std::to_string(pid_) + "/children"));
  for (int pid; list >> pid;) children.push_back(pid);
  return children;
}

Ran Runner::wait() {
  Ran ran;
  while (!pool_.isIdle())
    for (const os::WorkerNews& news : pool_.await(kLook_ns)) ran.failure = news.failure;
  ran.printed = slurped(printed_);
  return ran;
}

}  // namespace palpa::study
