#include <algorithm>
#include <cctype>
#include <cstdio>
#include <set>
#include <string_view>

#include "anatomy/base/counted.h"
#include "anatomy/base/error.h"
#include "anatomy/base/text_forms.h"
#include "anatomy/base/whole_file.h"
#include "apps/evidence/evidence_records.h"
#include "apps/os/file_access.h"
#include "apps/runtime/clock.h"
#include "apps/session/output_folder.h"
#include "apps/session/terminal.h"
#include "apps/station/assets.h"
#include "apps/study/analysis/study_row.h"
#include "apps/study/run/campaign_run.h"
#include "apps/study/run/participant.h"

namespace palpa::study {
namespace {

namespace fs = std::filesystem;
using study_analysis::CsvReader;
using Fields = std::vector<std::string>;

constexpr int kUsualParts = 100;
constexpr std::size_t kNamedAtMost = 10;

/// A session's own table.
struct SessionTable {
  Fields header;
  std::vector<Fields> rows;
};

SessionTable tableOf(const fs::path& result) {
  const fs::path file = result / "trials.csv";
  const auto damaged = [&file] {
    return Error("is damaged", file.string(), "Remove its folder; the next run computes it again");
  };
  const std::string text = readWhole(file).value_or("");
  SessionTable table;
  CsvReader reader(text, file.string());
  CsvReader::Line line;
  try {
    if (!reader.next(line)) throw damaged();
    table.header = line.fields;
    while (reader.next(line)) {
      if (line.fields.size() != table.header.size()) throw damaged();
      table.rows.push_back(line.fields);
    }
  } catch (const UsageError&) {  // nobody wrote this file by hand
    throw damaged();
  }
  return table;
}

std::string lineOf(const Fields& fields) {
  std::string line;
  for (const std::string& field : fields) line += (line.empty() ? "" : ",") + csvField(field);
  return line + '\n';
}

/// The columns of all tables, as they first appear.
Fields columnsOf(const PlannedCampaign& plan, const std::vector<bool>& there) {
  Fields columns;
  std::set<std::string> known;
  for (std::size_t n = 0; n < there.size(); ++n)
    if (there[n])
      for (const std::string& column : tableOf(plan.result(n)).header)
        if (known.insert(column).second) columns.push_back(column);
  return columns;
}

/// A row under the columns of all.
Fields spread(const Fields& header, const Fields& row, const Fields& columns) {
  if (header == columns) return row;
  Fields wide(columns.size());
  for (std::size_t i = 0; i < header.size(); ++i)
    wide[static_cast<std::size_t>(std::find(columns.begin(), columns.end(), header[i]) -
                                  columns.begin())] = row[i];
  return wide;
}

Fields placeOf(const PlannedCampaign& plan, std::size_t n) {
  const Campaign& c = plan.campaign;
  const CampaignSession s = sessionOf(c, n);
  return {c.tasks[s.task].stem().string(), c.patients[s.patient].name, c.operators[s.who].name,
          c.settings[s.setting].name};
}

Fields joined(Fields first, const Fields& then) {
  first.insert(first.end(), then.begin(), then.end());
  return first;
}

}  // namespace

std::size_t collectTable(const PlannedCampaign& plan) {
  std::vector<bool> there(plan.keys.size());
  for (std::size_t n = 0; n < there.size(); ++n) there[n] = fs::exists(plan.result(n));
  const Fields columns = columnsOf(plan, there);
  const fs::path file = plan.out / "trials.csv";
  WholeFile whole(file);
  whole.write(lineOf(joined({"TASK", "PATIENT", "OPERATOR", "SETTING"}, columns)));
  std::size_t trials = 0;
  for (std::size_t n = 0; n < there.size(); ++n) {
    if (!there[n]) continue;
    const SessionTable table = tableOf(plan.result(n));
    for (const Fields& row : table.rows)
      whole.write(lineOf(joined(placeOf(plan, n), spread(table.header, row, columns))));
    trials += table.rows.size();
  }
  whole.finish();
  const auto sessions = static_cast<std::size_t>(std::count(there.begin(), there.end(), true));
  std::printf("Written: %s: %s of %s\n", file.c_str(), counted(trials, "trial").c_str(),
              counted(sessions, "session").c_str());
  return there.size() - sessions;
}

void prepareRecords(const PlannedCampaign& plan) {
  if (plan.options.records.empty()) return;
  record::RecordStore store(evidence::absoluteRecords(plan.options.records));
  for (const CampaignOperator& who : plan.campaign.operators)
    addSimulated(store, "SIM-" + who.name, "simulated", runtime::utcNow());
}

void deliverCampaign(const PlannedCampaign& plan) {
  if (plan.options.records.empty()) return;
  const std::string url = evidence::absoluteRecords(plan.options.records);
  record::RecordStore store(url);
  session::WorkProgress progress("sessions in the records", static_cast<int>(plan.keys.size()),
                                 plan.options.quiet);
  int added = 0, present = 0;
  for (std::size_t n = 0; n < plan.keys.size(); ++n) {
    progress.done(static_cast<int>(n));
    const std::string uuid = sessionOptions(plan.campaign, n, plan.keys[n]).uuid;
    const auto known = static_cast<int>(store.trials({.session = uuid}).size());
    present += known;
    if (known >= plan.campaign.trials) continue;
    if (!plan.isDone(n))
      throw Error("lacks the evidence that records need", plan.result(n).string(),
                  "Run the campaign with --records, without --collect");
    added += evidence::deliverEvidence(plan.result(n) / "session.palpa", url).trials.added;
  }
  std::printf("In the %s: %s added, %d were there\n", store.place().c_str(),
              counted(added, "trial").c_str(), present);
}

void collectCampaign(const CampaignOptions& options) {
  const PlannedCampaign plan(options);
  if (!fs::exists(plan.out / "results"))
    throw UsageError("holds no results of a campaign", plan.out.string(),
                     "Run it first: palpa campaign " + options.file);
  prepareRecords(plan);
  if (const std::size_t missing = collectTable(plan))
    throw Error(std::to_string(missing) + " of " + counted(plan.keys.size(), "session") +
                    " missing in the table",
                options.file, "palpa campaign computes them; --status names them");
  deliverCampaign(plan);
}

void reportCampaign(const CampaignOptions& options) {
  const PlannedCampaign plan(options);
  std::set<std::string> ours;
  std::vector<std::size_t> missing;
  std::size_t done = 0, runs = 0;
  for (std::size_t n = 0; n < plan.keys.size(); ++n) {
    if (!ours.insert(plan.keys[n]).second) continue;
    if (plan.isDone(n)) {
      ++done;
    } else {
      missing.push_back(n);
      runs += os::isLocked(plan.work(n).string() + ".lock");
    }
  }
  std::size_t others = 0;
  for (const fs::path& result : entriesOf(plan.out / "results"))
    others += !ours.count(result.filename().string());
  std::printf("%s: %s\n", plan.campaign.title.c_str(), sizeInWords(plan.campaign).c_str());
  std::printf("%zu done, %zu to compute, of these %zu in work now\n", done, missing.size(), runs);
  for (std::size_t i = 0; i < missing.size() && i < kNamedAtMost; ++i)
    std::printf("  %s\n", plan.nameOf(missing[i]).c_str());
  if (missing.size() > kNamedAtMost) std::printf("  and %zu more\n", missing.size() - kNamedAtMost);
  if (others > 0)
    std::printf("%s of another program, campaign or asset: nobody needs them for this one\n",
                counted(others, "result").c_str());
}

namespace {

/// As a shell reads it as one word.
std::string shellWord(const std::string& text) {
  const bool plain = !text.empty() && std::all_of(text.begin(), text.end(), [](unsigned char c) {
    return std::isalnum(c) ||
           std::string_view("_-./=:@%+,").find(static_cast<char>(c)) != std::string_view::npos;
  });
  if (plain) return text;
  std::string word = "'";
  for (const char c : text) word += c == '\'' ? std::string("'\\''") : std::string(1, c);
  return word + "'";
}

/// The same from any folder.
std::string commandOf(const PlannedCampaign& plan) {
  constexpr const char* kWords[]{"table", "evidence", "reports"};
  const auto absolute = [](const fs::path& path) {
    return shellWord(fs::absolute(path).lexically_normal().string());
  };
  return shellWord(station::programFile().string()) + " campaign " + absolute(plan.options.file) +
         " --out " + absolute(plan.out) + " --keep " +
         kWords[static_cast<std::size_t>(plan.options.keeps)];
}

int partsOf(const PlannedCampaign& plan, int asked) {
  const auto sessions = static_cast<int>(plan.keys.size());
  return std::min(asked > 0 ? asked : kUsualParts, sessions);
}

}  // namespace

void listCampaignCommands(const CampaignOptions& options, int asked) {
  const PlannedCampaign plan(options);
  const int parts = partsOf(plan, asked);
  for (int part = 1; part <= parts; ++part)
    std::printf("%s --quiet --jobs 1 --part %d/%d\n", commandOf(plan).c_str(), part, parts);
}

void printCampaignSlurm(const CampaignOptions& options, int asked) {
  const PlannedCampaign plan(options);
  session::makeOutputFolder(plan.out.string(), "");  // where the jobs' output goes
  const std::string command = commandOf(plan), out = fs::absolute(plan.out).lexically_normal();
  const std::string& url = plan.options.records;
  const std::string records =
      url.empty() ? "" : " --records " + shellWord(evidence::absoluteRecords(url));
  const int parts = partsOf(plan, asked);  // of the whole array, whatever of it is submitted again
  std::printf(
      "#!/bin/sh\n"
      "# %s: %s.\n"
      "# Kept as campaign.sbatch:\n"
      "#   sbatch campaign.sbatch       computes what is missing, one part a job of an array\n"
      "#   %s%s --collect\n"
      "#       then, when all have ended: the table. As a job that waits for them:\n"
      "#   sbatch --dependency=afterany:$(sbatch --parsable campaign.sbatch) --wrap='...'\n"
      "#SBATCH --job-name=palpa-%s\n"
      "#SBATCH --array=1-%d\n"
      "#SBATCH --cpus-per-task=1\n"
      "#SBATCH --mem-per-cpu=1G\n"
      "#SBATCH --output=%s\n"
      "exec %s --quiet --jobs \"${SLURM_CPUS_PER_TASK:-1}\" \\\n"
      "  --part \"$SLURM_ARRAY_TASK_ID/%d\"\n",
      plan.campaign.title.c_str(), sizeInWords(plan.campaign).c_str(), command.c_str(),
      records.c_str(), plan.campaign.id.c_str(), parts, shellWord(out + "/slurm-%A_%a.txt").c_str(),
      command.c_str(), parts);
}

}  // namespace palpa::study
