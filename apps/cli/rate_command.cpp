#include <cmath>
#include <cstdio>
#include <memory>

#include "anatomy/base/counted.h"
#include "anatomy/base/error.h"
#include "anatomy/base/whole_file.h"
#include "apps/assess/competence/rating_agreement.h"
#include "apps/cli/arguments.h"
#include "apps/cli/commands.h"
#include "apps/cli/values.h"
#include "apps/evidence/rating_forms.h"
#include "apps/record/session_file.h"
#include "apps/report/paper/rating_form.h"
#include "apps/runtime/clock.h"
#include "apps/session/output_folder.h"

namespace palpa::cli {
namespace {

constexpr const char* kRateExamples = R"(Examples:
  palpa rate form --out form.html
      a blank form to print; type the marks into form.csv beside it afterwards
  palpa rate form --session out/A --trial 1 --records records.sqlite --out form-A1.html
      for one trial, with the simulator's own marks faintly beside
  palpa rate enter --session out/A --trial 1 --rater R1 --answers form.csv
  palpa rate agreement
      how far raters agree with each other and with the simulator
Raters are known by pseudonyms, as trainees are. A sheet that is entered again replaces the one before.)";

struct RateOptions {
  std::string checklist, global, records, session, rater, answers, out = "form.html";
  std::int64_t trial = 1;
  bool no_global = false;
};

std::string uuidOf(const std::string& session) {
  namespace fs = std::filesystem;
  const fs::path file =
      fs::is_directory(session) ? fs::path(session) / "session.palpa" : fs::path(session);
  return fs::is_regular_file(file) ? record::SessionReader(file).info().uuid : session;
}

record::TrialWithSession storedTrial(record::RecordStore& store, const std::string& uuid,
                                     std::int64_t number) {
  record::TrialFilter filter;
  filter.session = uuid;
  for (const record::TrialWithSession& t : store.trials(filter))
    if (t.trial.number == number) return t;
  throw UsageError("is not in the " + store.place(),
                   "trial " + std::to_string(number) + " of session " + uuid,
                   "Bring the session into the records first: palpa records add");
}

/// Beside the form, to type in what was marked. One that holds answers stays.
std::filesystem::path sheetFor(const std::string& page, const std::string& blank) {
  if (std::filesystem::path(page).extension() != ".html")
    throw UsageError("must end with .html", "--out " + page,
                     "The sheet to fill in lies beside it and ends with .csv");
  std::filesystem::path sheet = std::filesystem::path(page).replace_extension("csv");
  if (std::filesystem::exists(sheet) && evidence::textOf(sheet.string()) != blank)
    throw UsageError("already exists and may hold answers", sheet.string(), "Give another --out");
  return sheet;
}

void writeForm(const RateOptions& o) {
  const evidence::RatingForms forms = evidence::readForms(o.checklist, o.global);
  report::RatingForm form;
  form.checklist = &forms.checklist;
  form.global = o.no_global ? nullptr : &forms.global;
  if (!o.session.empty()) {
    record::RecordStore store(o.records);
    const record::TrialWithSession t = storedTrial(store, uuidOf(o.session), o.trial);
    form.trainee = t.session.trainee;
    form.session = t.session.uuid.substr(0, 8);
    form.when = t.session.started_utc.substr(0, 10);
    form.trial = static_cast<int>(o.trial);
    form.simulated = t.session.simulated;
    form.marks = competence::marked(forms.checklist, evidence::figuresOf(t.trial), {});
  }
  const std::string blank = report::answerSheet(forms.checklist, form.global);
  const std::filesystem::path sheet = sheetFor(o.out, blank);
  report::writeRatingForm(form, o.out);
  writeWhole(sheet, blank);
  std::printf("Written: %s, to print; %s, to fill in from it (palpa rate enter)\n", o.out.c_str(),
              sheet.string().c_str());
}

void enter(const RateOptions& o) {
  const evidence::RatingForms forms = evidence::readForms(o.checklist, o.global);
  const competence::FormAnswers answers = competence::parseAnswers(
      evidence::textOf(o.answers), o.answers, forms.checklist, &forms.global);
  if (answers.checklist.empty() && answers.global.empty())
    throw UsageError("holds no answers", o.answers, "Fill in the values");
  record::RecordStore store(o.records);
  const std::string uuid = uuidOf(o.session), now = runtime::utcNow();
  const auto sheet = [&](const competence::Answers& said, const std::string& form,
                         const std::string& sha) {
    std::vector<record::Rating> ratings;
    for (const auto& [item, value] : said)
      ratings.push_back({uuid, o.trial, o.rater, form, sha, item, value, now});
    record::enterRatings(store, ratings);
  };
  sheet(answers.checklist, forms.checklist.id, forms.checklist_sha256);
  sheet(answers.global, forms.global.id, forms.global_sha256);
  std::printf("Trial %lld, rater %s: %zu of %zu items of the checklist, %zu of %zu grades\n",
              static_cast<long long>(o.trial), o.rater.c_str(), answers.checklist.size(),
              forms.checklist.items.size(), answers.global.size(), forms.global.items.size());
}

/// Every trial in the records that somebody rated on these editions of the forms.
std::vector<competence::RatedTrial> ratedTrials(record::RecordStore& store,
                                                const evidence::RatingForms& forms,
                                                int* other_editions, bool* simulated) {
  std::map<std::pair<std::string, std::int64_t>, competence::RatedTrial> trials;
  for (const record::Rating& r : record::ratingsIn(store)) {
    const bool of_list = r.form == forms.checklist.id;
    if (r.form_sha256 != (of_list ? forms.checklist_sha256 : forms.global_sha256)) {
      ++*other_editions;
      continue;
    }
    competence::RatedTrial& trial = trials[{r.session, r.number}];
    (of_list ? trial.checklist : trial.global)[r.rater][r.item] = static_cast<int>(r.value);
  }
  std::vector<competence::RatedTrial> all;
  for (auto& [key, trial] : trials) {
    const record::TrialWithSession t = storedTrial(store, key.first, key.second);
    trial.simulator = competence::marked(forms.checklist, evidence::figuresOf(t.trial), {});
    if (const double total = t.trial.metric("total"); std::isfinite(total)) trial.total = total;
    *simulated = *simulated || t.session.simulated;
    all.push_back(std::move(trial));
  }
  return all;
}

void print(const char* name, const statistics::Icc& icc) {
  std::printf("  %-46s %5.2f (%.2f to %.2f)\n", name, icc.value, icc.low, icc.high);
}

void print(const competence::Agreement& a) {
  for (const competence::PairAgreement& p : a.checklist) {
    std::printf("Checklist, %s and %s: %d items, %.0f %% alike, ", p.one.c_str(), p.other.c_str(),
                p.items, 100 * p.alike);
    if (std::isfinite(p.kappa))
      std::printf("kappa %.2f\n", p.kappa);
    else
      std::printf("no kappa: both always said one and the same\n");
  }
  if (a.global) {
    std::printf("Global rating, %zu raters, %d trials; ICC with 95 %% interval:\n", a.raters.size(),
                a.trials);
    print("ICC(2,1) one rater, agreement", a.global->agreement);
    print("ICC(3,1) one rater, order only", a.global->consistency);
    print("ICC(2,k) mean of these raters, agreement", a.global->agreement_mean);
  }
  if (a.with_total)
    std::printf(
        "Global rating and total penalty, %d trials: Spearman's correlation %.2f (negative: well "
        "rated is little penalty)\n",
        a.scored, *a.with_total);
  for (const std::string& text : a.missing) std::printf("%s\n", text.c_str());
}

void reportAgreement(const RateOptions& o) {
  const evidence::RatingForms forms = evidence::readForms(o.checklist, o.global);
  record::RecordStore store(o.records);
  int other_editions = 0;
  bool simulated = false;
  const std::vector<competence::RatedTrial> trials =
      ratedTrials(store, forms, &other_editions, &simulated);
  std::printf("%s in the %s%s\n", counted(trials.size(), "rated trial").c_str(),
              store.place().c_str(), simulated ? "; simulated trials are among them" : "");
  if (other_editions)
    std::printf("Left out: %s on other editions of these forms\n",
                counted(other_editions, "rating").c_str());
  print(competence::agreementOf(trials));
}

CLI::App* sub(CLI::App* parent, const std::shared_ptr<RateOptions>& o, const char* name,
              const char* help, void (*action)(const RateOptions&)) {
  CLI::App* command = parent->add_subcommand(name, help);
  addRecordsArgument(*command, o->records);
  command->add_option("--checklist", o->checklist, "Checklist (default: the shipped one)")
      ->type_name("FILE");
  command->add_option("--global", o->global, "Global rating (default: the shipped one)")
      ->type_name("FILE");
  command->callback([o, action] { action(*o); });
  return command;
}

CLI::Option* addTrial(CLI::App* command, RateOptions& o) {
  command->add_option("--trial", o.trial, "Number of the trial (default 1)")
      ->check(inRange(1, 100000));
  return command
      ->add_option("--session", o.session, "A session's folder, or its UUID in the records")
      ->type_name("DIR|UUID");
}

}  // namespace

void addRate(CLI::App& program) {
  CLI::App* command =
      program.add_subcommand("rate", "Human raters: forms, what they marked, how far they agree");
  command->require_subcommand(1);
  command->footer(kRateExamples);
  const auto o = std::make_shared<RateOptions>();
  CLI::App* form = sub(command, o, "form", "A form to print, blank or for one trial", writeForm);
  addTrial(form, *o);
  form->add_flag("--no-global", o->no_global, "The checklist alone");
  form->add_option("--out", o->out, "Page to write (default form.html)")->type_name("FILE");
  CLI::App* typed = sub(command, o, "enter", "Enter a rater's marks into the records", enter);
  addTrial(typed, *o)->required();
  typed->add_option("--rater", o->rater, "The rater's pseudonym")
      ->required()
      ->check(record::whyNoPseudonym);
  typed->add_option("--answers", o->answers, "Lines of item,value, typed in from the printed form")
      ->required()
      ->type_name("FILE");
  sub(command, o, "agreement", "Agreement of raters with each other and with the simulator",
      reportAgreement);
}

}  // namespace palpa::cli
