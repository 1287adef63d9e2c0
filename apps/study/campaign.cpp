#include "apps/study/campaign.h"

#include <set>

#include "anatomy/base/counted.h"
#include "anatomy/base/file_schema.h"
#include "anatomy/base/json_file.h"
#include "anatomy/base/text_forms.h"
#include "apps/record/store/record_store.h"
#include "apps/station/assets.h"
#include "apps/study/protocol.h"

namespace palpa::study {
namespace {

namespace fs = std::filesystem;
using training::Engine;

constexpr int kMostOfAKind = 100'000, kMostTrialsOfASession = 1000, kLastSeed = 1'000'000'000;
constexpr double kMostSessions = 100'000, kMostTrialsInAll = 1'000'000;
constexpr std::size_t kLongestTitle = 200;
constexpr const char* kSkilled[]{"expert", "novice"};

fs::path besidesCampaign(const JsonFile& file, const std::string& field, const std::string& name) {
  fs::path found = fs::path(file.name()).parent_path() / name;
  std::error_code none;
  if (name.empty() || !fs::is_regular_file(found, none))
    file.refuse(field, "names \"" + name + "\", which is not there");
  return found;
}

std::vector<fs::path> filesNamed(const JsonFile& file, const std::string& field) {
  std::vector<fs::path> all;
  for (const std::string& name : file.texts(field))
    all.push_back(besidesCampaign(file, field, name));
  if (all.empty()) file.refuse(field, "is empty");
  return all;
}

void readTasks(const JsonFile& file, Campaign* campaign) {
  campaign->tasks = filesNamed(file, "tasks");
  std::set<std::string> names;
  for (const fs::path& task : campaign->tasks) {
    if (!names.insert(task.stem().string()).second)
      file.refuse("tasks", "has two files named \"" + task.stem().string() + "\"");
    const Engine engine = training::engineIn(JsonFile(task));
    if (task != campaign->tasks.front() && engine != campaign->engine)
      file.refuse("tasks", "are of different engines: " + training::nameOf(campaign->engine) +
                               " and " + training::nameOf(engine));
    campaign->engine = engine;
  }
}

/// Whose trials can be found in records: "SIM-" and this is a trainee's pseudonym.
void needOperatorName(const JsonFile& file, const std::string& name) {
  if (!record::whyNoPseudonym("SIM-" + name).empty())
    file.refuse("operators",
                "names \"" + name + "\"; a file's name here has 1 to 28 letters, digits, - or _");
}

void readOperators(const JsonFile& file, Campaign* campaign) {
  std::set<std::string> names;
  for (const std::string& text : file.texts("operators")) {
    CampaignOperator who{text, {}};
    if (text != kSkilled[0] && text != kSkilled[1]) {
      who.file = besidesCampaign(file, "operators", text);
      who.name = who.file.stem().string();
      needOperatorName(file, who.name);
    }
    if (!names.insert(who.name).second)
      file.refuse("operators", "has \"" + who.name + "\" more than once");
    campaign->operators.push_back(who);
  }
  if (names.empty()) file.refuse("operators", "is empty");
}

void readPatients(const JsonFile& file, Campaign* campaign) {
  const bool drawn = file.has("patients"), given = file.has("patient_files");
  if (!drawn && !given) return campaign->patients.push_back({"reference", 0, {}});
  if (campaign->engine != Engine::needle)
    file.refuse(drawn ? "patients" : "patient_files", "has a meaning for needle tasks alone");
  if (drawn) {
    const int from = file.integer("patients/from", 0, kLastSeed);
    const int count = file.integer("patients/count", 1, kMostOfAKind);
    for (int i = 0; i < count; ++i) {
      const int seed = from + i;
      campaign->patients.push_back({seed == 0 ? "reference" : "seed " + std::to_string(seed),
                                    static_cast<std::uint64_t>(seed),
                                    {}});
    }
  }
  if (!given) return;
  std::set<std::string> names;
  for (const CampaignPatient& patient : campaign->patients) names.insert(patient.name);
  for (const fs::path& patient : filesNamed(file, "patient_files")) {
    campaign->patients.push_back({patient.stem().string(), 0, patient});
    if (!names.insert(campaign->patients.back().name).second)
      file.refuse("patient_files",
                  "has a second patient named \"" + patient.stem().string() + "\"");
  }
}

/// A field that another engine's tasks have.
void refuseOthers(const JsonFile& file, Engine engine) {
  const bool needle = engine == Engine::needle, palpation = engine == Engine::palpation;
  const std::pair<const char*, bool> fields[]{
      {"augment", needle || palpation}, {"guidance", palpation}, {"mode", engine == Engine::search},
      {"knows_patient", needle},        {"handedness", needle},  {"side", needle}};
  for (const auto& [field, has_meaning] : fields)
    if (!has_meaning && file.has(field))
      file.refuse(field, "has no meaning for tasks of the engine " + training::nameOf(engine));
}

bool isLeft(const JsonFile& file, const std::string& field) {
  if (!file.has(field)) return false;
  const std::string side = file.text(field);
  if (side != "left" && side != "right") file.refuse(field, "must be left or right");
  return side == "left";
}

bool isByModel(const JsonFile& file) {
  if (!file.has("tracking")) return false;
  const std::string by = file.text("tracking");
  if (by != "images" && by != "model") file.refuse("tracking", "must be images or model");
  return by == "model";
}

std::string modeIn(const JsonFile& file) {
  if (!file.has("mode")) return "real";
  static const std::set<std::string> kModes{"real", "degraded", "augmented", "all"};
  std::string mode = file.text("mode");
  if (!kModes.count(mode)) file.refuse("mode", "must be real, degraded, augmented or all");
  return mode;
}

CampaignSetting campaignSetting(const JsonFile& file, Engine engine, const fs::path& folder) {
  refuseOthers(file, engine);
  CampaignSetting s;
  s.name = needName(file, "name");
  s.force_feedback = file.flag("force_feedback", true);
  s.augment = file.flag("augment", false);
  s.assess = file.flag("assess", false);
  s.knows_patient = file.flag("knows_patient", false);
  s.guidance = file.flag("guidance", false);
  s.left_handed = isLeft(file, "handedness");
  s.left_side = isLeft(file, "side");
  s.mode = modeIn(file);
  s.tracking_model = isByModel(file);
  if (file.has("presentation"))
    s.presentation = presentation::presentationNamed(
        file.text("presentation"), station::assetFile("presentations"), folder, file.name());
  return s;
}

void readSettings(const JsonFile& file, Campaign* campaign) {
  std::set<std::string> names;
  for (const JsonFile& entry : file.entries("settings")) {
    campaign->settings.push_back(
        campaignSetting(entry, campaign->engine, campaign->file.parent_path()));
    if (!names.insert(campaign->settings.back().name).second)
      entry.refuse("name", "is another setting's, too");
  }
  if (names.empty()) campaign->settings.push_back({.name = "usual", .presentation = {}});
}

double combinations(const Campaign& c) {
  return static_cast<double>(c.tasks.size()) * static_cast<double>(c.patients.size()) *
         static_cast<double>(c.operators.size()) * static_cast<double>(c.settings.size());
}

void refuseAbsurd(const JsonFile& file, const Campaign& campaign) {
  const double sessions = combinations(campaign) * campaign.seeds;
  if (sessions > kMostSessions)
    file.refuse("seeds", "make " + sizeInWords(campaign) + "; a campaign has at most 100,000");
  if (sessions * campaign.trials > kMostTrialsInAll)
    file.refuse("trials", "make " + sizeInWords(campaign) + "; at most 1,000,000 trials in all");
}

}  // namespace

std::size_t Campaign::sessions() const {
  return static_cast<std::size_t>(combinations(*this) * seeds);
}

Campaign readCampaign(const fs::path& path) {
  const JsonFile file(path);
  needKind(file, "campaign", 1);
  Campaign c;
  c.file = path;
  c.id = needName(file, "id");
  c.title = plainText(file.text("title"), kLongestTitle);
  readTasks(file, &c);
  if (file.has("station")) c.station = besidesCampaign(file, "station", file.text("station"));
  readOperators(file, &c);
  readPatients(file, &c);
  readSettings(file, &c);
  c.first_seed = static_cast<std::uint64_t>(file.integer("seeds/from", 0, kLastSeed));
  c.seeds = file.integer("seeds/count", 1, kMostOfAKind);
  if (file.has("trials")) c.trials = file.integer("trials", 1, kMostTrialsOfASession);
  refuseAbsurd(file, c);
  return c;
}

CampaignSession sessionOf(const Campaign& campaign, std::size_t n) {
  const auto within = [&n](std::size_t count) {
    const std::size_t place = n % count;
    n /= count;
    return place;
  };
  CampaignSession session;
  session.seed = campaign.first_seed + within(static_cast<std::size_t>(campaign.seeds)) *
                                           static_cast<std::uint64_t>(campaign.trials);
  session.setting = within(campaign.settings.size());
  session.who = within(campaign.operators.size());
  session.patient = within(campaign.patients.size());
  session.task = n;
  return session;
}

std::string sizeInWords(const Campaign& c) {
  std::string words;
  const auto times = [&words](std::size_t count, const char* one) {
    if (count > 1) words += (words.empty() ? "" : " x ") + counted(count, one);
  };
  times(c.tasks.size(), "task");
  times(c.patients.size(), "patient");
  times(c.operators.size(), "operator");
  times(c.settings.size(), "setting");
  times(static_cast<std::size_t>(c.seeds), "seed");
  return words + (words.empty() ? "" : " = ") +
         counted(static_cast<std::uint64_t>(combinations(c) * c.seeds), "session") + " of " +
         counted(c.trials, "trial") + " each";
}

}  // namespace palpa::study
