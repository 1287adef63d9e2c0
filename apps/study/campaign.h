#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "apps/presentation/presentation.h"
#include "apps/training/engine.h"

namespace palpa::study {

struct CampaignOperator {
  std::string name;            ///< "expert", "novice", or the file's name without its ending
  std::filesystem::path file;  ///< empty: the one that is shipped for the engine
};

struct CampaignPatient {
  std::string name;            ///< "reference", "seed 3", or the file's name without its ending
  std::uint64_t seed = 0;      ///< 0: the reference patient
  std::filesystem::path file;  ///< empty: built from reference figures
};

/// What differs between sessions besides who performs on whom. Fields as the options of a session.
struct CampaignSetting {
  std::string name;
  bool force_feedback = true, augment = false, assess = false;
  bool knows_patient = false, guidance = false, left_handed = false, left_side = false;
  bool tracking_model = false;  ///< in place of pictures
  std::string mode = "real";
  std::optional<presentation::Presentation> presentation;
};

/// Simulated sessions to be held: each task with each patient, operator and setting, as often as
/// there are seeds. Files as they are found from here.
struct Campaign {
  std::filesystem::path file;
  std::string id, title;
  training::Engine engine = training::Engine::needle;  ///< of every task
  std::vector<std::filesystem::path> tasks;
  std::filesystem::path station;  ///< empty: the virtual bench
  std::vector<CampaignPatient> patients;
  std::vector<CampaignOperator> operators;
  std::vector<CampaignSetting> settings;
  std::uint64_t first_seed = 1;
  int seeds = 1;   ///< sessions of each combination
  int trials = 1;  ///< of each session; no two sessions of a combination share a trial's seed
  std::size_t sessions() const;
};

/// One of them. Numbers are places in the campaign's lists.
struct CampaignSession {
  std::size_t task = 0, patient = 0, who = 0, setting = 0;
  std::uint64_t seed = 1;  ///< of its first trial
};

/// Throws UsageError naming file and field; also for more than 100,000 sessions or 1,000,000
/// trials.
Campaign readCampaign(const std::filesystem::path& file);

/// The nth, 0 to `sessions()` - 1. Seeds change first, then settings, operators, patients, tasks.
CampaignSession sessionOf(const Campaign& campaign, std::size_t n);

/// "2 operators x 5 patients x 50 seeds x 2 settings = 1000 sessions of 1 trial each": what is once
/// is left out.
std::string sizeInWords(const Campaign& campaign);

}  // namespace palpa::study
