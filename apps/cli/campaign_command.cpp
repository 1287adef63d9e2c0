#include <charconv>
#include <map>
#include <memory>

#include "anatomy/base/error.h"
#include "apps/cli/arguments.h"
#include "apps/cli/commands.h"
#include "apps/cli/values.h"
#include "apps/study/run/campaign_run.h"

namespace palpa::cli {
namespace {

using study::CampaignKeeps;
using study::CampaignOptions;

constexpr const char* kCampaignExamples = R"(Examples:
  palpa campaign assets/campaigns/needle_by_touch.json
      every session that the file asks for, on all processors; out/campaign-needle_by_touch/trials.csv holds every trial
  palpa campaign assets/campaigns/needle_by_touch.json --status
      what is done, what is missing; after an interruption or a change of the file the first command computes what is missing
  palpa campaign my.json --out /data/my --slurm > my.sbatch
      a job array for a cluster with Slurm; sbatch my.sbatch, and when it has ended: palpa campaign my.json --out /data/my --collect
  palpa campaign my.json --out /data/my --list-commands 40 | parallel
      the same in forty parts, by any scheduler that takes commands
  palpa campaign my.json --records postgresql://palpa@server/palpa
      the trials go to the records as well, each of them once
A result is known by what it follows from: the program, each file's bytes, each option. What is there is never computed again.)";

const std::map<std::string, CampaignKeeps> kKeeps{{"table", CampaignKeeps::table},
                                                  {"evidence", CampaignKeeps::evidence},
                                                  {"reports", CampaignKeeps::reports}};

/// "2/7" into its numbers; false: it is none.
bool readPart(const std::string& text, CampaignOptions* o) {
  const char *at = text.data(), *end = at + text.size();
  const auto first = std::from_chars(at, end, o->part);
  if (first.ec != std::errc() || first.ptr == end || *first.ptr != '/') return false;
  const auto then = std::from_chars(first.ptr + 1, end, o->parts);
  return then.ec == std::errc() && then.ptr == end && o->part >= 0 && o->parts >= 1 &&
         o->part <= o->parts;
}

CLI::Validator aPart() {
  return {[](const std::string& typed) {
            CampaignOptions read;
            return readPart(typed, &read)
                       ? std::string()
                       : "needs a part and how many there are, such as 2/7, not " + quoted(typed);
          },
          ""};
}

/// What there is to do besides running.
struct Actions {
  bool collect = false, status = false;
  int commands = 0, slurm = 0;  ///< parts
  CLI::Option *list = nullptr, *script = nullptr;
};

void addActions(CLI::App& command, Actions& actions) {
  CLI::Option* others[]{
      command.add_flag("--collect", actions.collect,
                       "Compute nothing: write the table of what is there (and the records)"),
      command.add_flag("--status", actions.status,
                       "Compute nothing: say what is done, runs, is missing"),
      actions.list =
          command
              .add_option("--list-commands", actions.commands,
                          "Print this many commands, one a line, that share the work: for GNU "
                          "parallel, xargs or any scheduler (default 100)")
              ->expected(0, 1)
              ->check(inRange(1, 100000)),
      actions.script =
          command
              .add_option("--slurm", actions.slurm,
                          "Print a script for sbatch: the same as an array of this many jobs "
                          "(default 100)")
              ->expected(0, 1)
              ->check(inRange(1, 100000))};
  for (CLI::Option* one : others)
    for (CLI::Option* other : others)
      if (one != other) one->excludes(other);
}

/// What is computed, and where; --keep.
const CLI::Option* addRunning(CLI::App& command, CampaignOptions& o) {
  command
      .add_option(
          "--out", o.out,
          "Folder for the results (default out/campaign-<id>); campaigns may share one: its "
          "trials.csv is of the one that was collected last")
      ->type_name("DIR");
  command
      .add_option("--jobs", o.jobs,
                  "Processes at a time (default: one a processor); changes no result")
      ->check(inRange(1, 4096));
  command
      .add_option_function<std::string>(
          "--part", [&o](const std::string& text) { readPart(text, &o); },
          "Only this part of the work: I/N, with I from 1 to N (or from 0: N is 0, too)")
      ->type_name("I/N")
      ->check(aPart());
  const CLI::Option* keep =
      command
          .add_option_function<std::string>(
              "--keep", [&o](const std::string& text) { o.keeps = kKeeps.at(text); },
              "What stays of each session: its table (default); that and session.palpa, for replay "
              "and records (evidence, the default with --records; 45 MB a minute with a needle); "
              "these and report.html (reports)")
          ->check(oneOf(keysOf(kKeeps)))
          ->type_name("evidence|reports|table");
  command
      .add_option("--records", o.records,
                  "Add the trials to these records, as those of simulated trainees: a file, or "
                  "postgresql://user@host/database")
      ->type_name("FILE|URL");
  command.add_flag("--quiet", o.quiet, "No progress on standard error");
  return keep;
}

void act(CampaignOptions o, const Actions& actions, bool keep_given) {
  if (!o.records.empty() && !keep_given) o.keeps = CampaignKeeps::evidence;
  if (!o.records.empty() && o.keeps == CampaignKeeps::table)
    throw UsageError("need the evidence", "--records with --keep table", "Leave one of them out");
  if (!o.records.empty() && o.parts > 1)
    throw UsageError("are for the whole", "--records with --part",
                     "Give them when all parts are done, with --collect");
  if (actions.list->count() > 0) return study::listCampaignCommands(o, actions.commands);
  if (actions.script->count() > 0) return study::printCampaignSlurm(o, actions.slurm);
  if (actions.status) return study::reportCampaign(o);
  if (actions.collect) return study::collectCampaign(o);
  study::runCampaign(o);
}

}  // namespace

void addCampaign(CLI::App& program) {
  const auto o = std::make_shared<CampaignOptions>();
  const auto actions = std::make_shared<Actions>();
  CLI::App* command = program.add_subcommand(
      "campaign",
      "Simulated sessions by the thousand: operators x patients x seeds x settings, on all "
      "processors or a cluster; nothing is computed twice");
  command->footer(kCampaignExamples);
  command->add_option("file", o->file, "Campaign file, like those in assets/campaigns")
      ->required()
      ->type_name("FILE")
      ->check(somethingThere("campaigns"));
  const CLI::Option* keep = addRunning(*command, *o);
  addActions(*command, *actions);
  command->callback([o, actions, keep] { act(*o, *actions, keep->count() > 0); });
}

}  // namespace palpa::cli
