#include <functional>
#include <map>
#include <nlohmann/json.hpp>
#include <set>

#include "anatomy/base/sha256.h"
#include "anatomy/base/uuid.h"
#include "anatomy/base/whole_file.h"
#include "apps/station/assets.h"
#include "apps/study/run/campaign_run.h"

namespace palpa::study {
namespace {

namespace fs = std::filesystem;

/// The form of a result and of its key; another one makes every key another one.
constexpr char kForm[] = "palpa campaign session 1";
/// What a session may read of the program's own, whatever its files name.
constexpr const char* kReadByAll[]{"patients/reference.json",
                                   "stations",
                                   "operators",
                                   "presentations",
                                   "phantoms",
                                   "checklists",
                                   "tracking"};
/// Of the UUIDs of such sessions. [chosen] at random
constexpr char kNamespace[] = "7d0a6a3e-5a0b-4c0e-9d7c-5f1f3f5c2b61";
constexpr std::size_t kLongestName = 1024;

/// Every text in a file.
void eachText(const nlohmann::json& json, const std::function<void(const std::string&)>& use) {
  if (json.is_string()) use(json.get_ref<const std::string&>());
  if (json.is_structured())
    for (const nlohmann::json& below : json) eachText(below, use);
}

/// The digests of a file and of all files that it names, in the order in which they are named: a
/// text that, from where it stands, is a file's name is taken for one.
class NamedFiles {
 public:
  std::string text(const fs::path& first) {
    std::string& text = known_[first.lexically_normal()];
    if (text.empty()) {
      std::set<fs::path> seen;
      add(first, &seen, &text);
    }
    return text;
  }

 private:
  void add(const fs::path& given, std::set<fs::path>* seen, std::string* text) {
    const fs::path file = given.lexically_normal();
    if (!seen->insert(file).second) return;
    *text += " " + sha256OfFile(file);
    if (file.extension() != ".json") return;
    const nlohmann::json json =
        nlohmann::json::parse(readWhole(file).value_or(""), nullptr, /*allow_exceptions=*/false);
    eachText(json, [&](const std::string& name) {
      std::error_code none;
      const fs::path named = file.parent_path() / name;
      const bool may_be = !name.empty() && name.size() < kLongestName;
      if (may_be && fs::is_regular_file(named, none)) add(named, seen, text);
    });
  }

  std::map<fs::path, std::string> known_;
};

/// What every session of this program shares.
std::string programText(NamedFiles* files) {
  static const std::string program = sha256OfFile("/proc/self/exe");  // that runs, not its heir
  std::string text = std::string(kForm) + "\nprogram " + program + "\nassets";
  for (const char* name : kReadByAll) {
    const fs::path asset = station::assetFile(name);
    if (!fs::is_directory(asset)) text += files->text(asset);
    for (const fs::path& file : entriesOf(asset))
      if (fs::is_regular_file(file)) text += " " + file.filename().string() + files->text(file);
  }
  return text + "\n";
}

/// Of a setting all but its name.
std::string settingText(const CampaignSetting& s) {
  std::string text = "setting " + s.mode;
  for (const bool option : {s.force_feedback, s.augment, s.assess, s.knows_patient, s.guidance,
                            s.left_handed, s.left_side, s.tracking_model})
    text += option ? " 1" : " 0";
  return text + (s.presentation ? " " + presentation::jsonOf(*s.presentation).dump() : "") + "\n";
}

std::string patientText(const CampaignPatient& patient, NamedFiles* files) {
  return "patient" +
         (patient.file.empty() ? " seed " + std::to_string(patient.seed)
                               : files->text(patient.file)) +
         "\n";
}

/// The name is that of the trainee, in the table and the evidence.
std::string operatorText(const CampaignOperator& who, NamedFiles* files) {
  return "operator " + who.name + (who.file.empty() ? " shipped" : files->text(who.file)) + "\n";
}

}  // namespace

std::vector<std::string> keysOf(const Campaign& campaign) {
  NamedFiles files;
  const std::string station = campaign.station.empty() ? " usual" : files.text(campaign.station);
  const std::string shared = programText(&files) + "station" + station + "\n";
  std::vector<std::string> keys;
  for (std::size_t n = 0; n < campaign.sessions(); ++n) {
    const CampaignSession s = sessionOf(campaign, n);
    keys.push_back(sha256(shared + "task" + files.text(campaign.tasks[s.task]) + "\n" +
                          patientText(campaign.patients[s.patient], &files) +
                          operatorText(campaign.operators[s.who], &files) +
                          settingText(campaign.settings[s.setting]) + "seed " +
                          std::to_string(s.seed) + " trials " + std::to_string(campaign.trials)));
  }
  return keys;
}

session::SessionOptions sessionOptions(const Campaign& campaign, std::size_t n,
                                       const std::string& key) {
  using session::OperatorKind;
  const CampaignSession s = sessionOf(campaign, n);
  const CampaignSetting& setting = campaign.settings[s.setting];
  const CampaignOperator& who = campaign.operators[s.who];
  session::SessionOptions o;
  o.command = training::commandOf(campaign.engine);
  o.task = campaign.tasks[s.task].string();
  o.station = campaign.station.string();
  o.patient = campaign.patients[s.patient].file.string();
  o.patient_seed = campaign.patients[s.patient].seed;
  o.operator_file = who.file.string();
  o.who = !who.file.empty()      ? OperatorKind::custom
          : who.name == "novice" ? OperatorKind::novice
                                 : OperatorKind::expert;
  o.trainee = "SIM-" + who.name;
  o.seed = s.seed;
  o.trials = campaign.trials;
  o.side = setting.left_side ? anatomy::Side::left : anatomy::Side::right;
  o.left_handed = setting.left_handed;
  o.knows_patient = setting.knows_patient;
  o.force_feedback = setting.force_feedback;
  o.presentation = setting.presentation;
  o.augment = setting.augment;
  o.assess = setting.assess;
  o.guidance = setting.guidance;
  o.mode = setting.mode;
  if (setting.tracking_model) o.tracking = session::Tracking::model;
  o.fast = o.no_views = o.quiet = true;
  o.display = scene::Display::offscreen;
  o.report = o.noted = false;
  if (!key.empty()) o.uuid = uuidOfName(kNamespace, key);
  return o;
}

}  // namespace palpa::study
