#pragma once

#include <cstddef>
#include <filesystem>
#include <string>
#include <vector>

#include "apps/session/session_options.h"
#include "apps/study/campaign.h"

/// Campaigns of simulated sessions: independent pieces of work whose results are never computed
/// twice. What follows throws UsageError and Error.
namespace palpa::study {

/// What stays of a session. Each holds what the one before does.
enum class CampaignKeeps {
  table,     ///< trials.csv
  evidence,  ///< session.palpa, for replay and records
  reports    ///< report.html
};

/// What `palpa campaign` understands.
struct CampaignOptions {
  std::string file;
  std::string out;      ///< empty: out/campaign-<id>, the same in every run
  std::string records;  ///< empty: none
  int jobs = 0;         ///< processes at a time; 0: one a processor
  int part = 0;         ///< of so many parts, from 0 or from 1: the last is the 0th, too
  int parts = 1;
  CampaignKeeps keeps = CampaignKeeps::table;  ///< records need the evidence
  bool quiet = false;
};

/// A campaign and where its results are: out/results/<key>, a folder a session, which takes its
/// name when it is whole; before, it stands in the folder `work` beside <key>.lock, which whoever
/// computes it holds. Two that run beside each other, also on two computers, compute nothing twice.
struct PlannedCampaign {
  Campaign campaign;
  CampaignOptions options;
  std::filesystem::path out;
  /// Of each session: SHA-256 of all that its result follows from
  std::vector<std::string> keys;

  explicit PlannedCampaign(const CampaignOptions& options);
  std::filesystem::path result(std::size_t session) const {
    return out / "results" / keys[session];
  }
  std::filesystem::path work(std::size_t session) const { return out / "work" / keys[session]; }
  /// Its result is there, with what is to be kept.
  bool isDone(std::size_t session) const;
  bool isInPart(std::size_t session) const;
  /// "paracentesis, seed 3, novice, touch, seed 17"
  std::string nameOf(std::size_t session) const;
};

/// A session's key is the SHA-256 of a text that names the program's bytes, the bytes of every file
/// that the session may read (those that the campaign names, those that these name, and so on, and
/// what any session reads of the program's own), and its options. No place, date or host is in it.
std::vector<std::string> keysOf(const Campaign& campaign);

/// The options with which a session of a campaign is held: in virtual time, without views, for the
/// simulated trainee "SIM-" and the operator's name. Its UUID follows from its key.
session::SessionOptions sessionOptions(const Campaign& campaign, std::size_t session,
                                       const std::string& key);

/// Of what is there: every trial to out/trials.csv; how many results are missing.
std::size_t collectTable(const PlannedCampaign& plan);
/// Opens the records and names the simulated people, so that what is wrong with them is told before
/// anything is computed. Nothing where there are none to fill.
void prepareRecords(const PlannedCampaign& plan);
/// The records, prepared before, get what they lack.
void deliverCampaign(const PlannedCampaign& plan);

/// Computes what is missing of its part, a process a session. Where it was all, the table is
/// collected as well. Error when a session failed or somebody interrupts: the others are done, and
/// the next run goes on.
void runCampaign(const CampaignOptions& options);

/// Writes out/trials.csv: every trial in the campaign's order, with task, patient, operator and
/// setting before the columns of the sessions' own tables; the same bytes whoever computed what.
/// Then the records get what they lack. Error where results are missing: the table has the others.
void collectCampaign(const CampaignOptions& options);

/// What is done, runs, is missing.
void reportCampaign(const CampaignOptions& options);

/// Prints one command a line, each for one of so many parts (0: as many as make sense): for GNU
/// parallel, xargs or any scheduler.
void listCampaignCommands(const CampaignOptions& options, int parts);

/// Prints a script for Slurm's sbatch: the same as a job array.
void printCampaignSlurm(const CampaignOptions& options, int parts);

}  // namespace palpa::study
