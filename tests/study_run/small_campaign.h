#pragma once

#include <gtest/gtest.h>

#include <cstddef>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "apps/os/worker_processes.h"
#include "apps/study/run/campaign_run.h"
#include "tests/support/scratch_folder.h"

/// Campaigns of sessions that are as short as sessions can be.
namespace palpa::study {

const std::filesystem::path kAssets = std::filesystem::path(PALPA_SOURCE_DIR) / "assets";

/// A campaign in a folder of its own, with whatever it needs.
class SmallCampaign : public testing::Test {
 protected:
  SmallCampaign();
  /// `seeds` x expert and novice x with and without force: each one comparison of two things.
  std::filesystem::path comparisons(int seeds) const;
  std::filesystem::path put(const std::string& name, const nlohmann::json& file) const;
  CampaignOptions options(const std::filesystem::path& file, const std::string& out) const;
  std::filesystem::path tableIn(const std::string& out) const { return here_ / out / "trials.csv"; }
  /// Every result in it, sorted.
  std::vector<std::filesystem::path> resultsIn(const std::string& out) const;

  const test::ScratchFolder here_;
};

/// What happened in a process of its own that ran one.
struct Ran {
  std::string printed;   ///< on both streams
  std::string failure;   ///< what was thrown; empty: nothing
  int computed() const;  ///< as it printed; -1: it did not
};

/// A campaign that is run in a process of its own.
class Runner {
 public:
  Runner(const CampaignOptions& options, const std::filesystem::path& printed);
  int pid() const { return pid_; }
  /// Of the processes that it has started and that run now.
  std::vector<int> workers() const;
  Ran wait();

 private:
  const std::filesystem::path printed_;
  os::WorkerPool pool_;
  int pid_ = 0;
};

std::string slurped(const std::filesystem::path& file);
std::size_t linesIn(const std::string& text);

}  // namespace palpa::study
