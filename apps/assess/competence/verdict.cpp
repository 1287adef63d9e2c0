#include "apps/assess/competence/verdict.h"

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "anatomy/base/counted.h"
#include "apps/assess/metrics/metric_table.h"

namespace palpa::competence {
namespace {

std::string plain(double value) {
  char text[32];
  std::snprintf(text, sizeof text, "%.*f", value == std::round(value) ? 0 : 1, value);
  return text;
}

std::string withUnit(double value, const std::string& metric) {
  const metrics::MetricDefinition* definition = metrics::metricNamed(metric);
  const std::string unit = definition ? definition->unit : "1";
  return plain(value) + (unit == "1" ? "" : unit == "deg" ? "°" : " " + unit);
}

std::string limits(const Rule& rule) {
  const bool low = std::isfinite(rule.at_least), high = std::isfinite(rule.at_most);
  if (low && high)
    return withUnit(rule.at_least, rule.metric) + " to " + withUnit(rule.at_most, rule.metric);
  return low ? "at least " + withUnit(rule.at_least, rule.metric)
             : "at most " + withUnit(rule.at_most, rule.metric);
}

std::string titleOf(const Rule& rule) {
  const metrics::MetricDefinition* definition = metrics::metricNamed(rule.metric);
  return definition ? definition->title : rule.metric;
}

MarkedItem byRater(const ChecklistItem& item, const Answers& rater) {
  const auto said = rater.find(item.id);
  if (said == rater.end()) return {&item, Mark::open, ""};
  return {&item,
          said->second == kDone      ? Mark::done
          : said->second == kNotDone ? Mark::not_done
                                     : Mark::did_not_arise,
          ""};
}

/// Where a figure was not kept, a rater may say it.
MarkedItem byFigures(const ChecklistItem& item, const Figures& figures, const Answers& rater) {
  MarkedItem marked{&item, Mark::done, ""};
  for (const Rule& rule : item.rules) {
    const std::optional<double> value = figures(rule.metric);
    if (!value) {
      MarkedItem said = byRater(item, rater);
      if (said.mark == Mark::open) said.why = titleOf(rule) + " was not kept";
      return said;
    }
    if (std::isnan(*value))
      marked = {&item, item.may_not_arise ? Mark::did_not_arise : Mark::not_done,
                item.may_not_arise ? "" : titleOf(rule) + ": it did not come to that"};
    else if (!rule.holds(*value))
      return {&item, Mark::not_done,
              titleOf(rule) + ": " + withUnit(*value, rule.metric) + " (" + limits(rule) + ")"};
  }
  return marked;
}

void judgeCritical(const Checklist& checklist, const Figures& figures, Verdict* v,
                   std::vector<std::string>* missing) {
  for (const CriticalError& error : checklist.critical) {
    const std::optional<double> value = figures(error.rule.metric);
    if (!value)
      missing->push_back("It cannot be told whether " + error.text +
                         ": the record is older than that figure.");
    else if (error.rule.holds(*value))
      v->critical.push_back(error.text);
  }
  for (const std::string& text : v->critical) v->reasons.push_back("Critical error: " + text + ".");
}

std::string percent(double share) {
  return plain(100 * std::floor(1e3 * share + 1e-9) / 1e3) + " %";
}

void judgeChecklist(const ChecklistScore& score, double standard, Verdict* v,
                    std::vector<std::string>* missing) {
  const std::string asked = percent(standard) + " is asked for";
  const int applicable = score.done + score.not_done + score.open;
  const std::string of = " of " + std::to_string(applicable) + " items";
  if (score.high < standard - 1e-9)
    v->reasons.push_back("Checklist: " + std::to_string(score.done) + of + " done" +
                         (score.open ? ", at most " + percent(score.high) + " whatever a rater says"
                                     : " (" + percent(score.high) + ")") +
                         "; " + asked + ".");
  else if (score.low < standard - 1e-9)
    missing->push_back("Checklist: " + std::to_string(score.done) + of + " done; " +
                       std::to_string(score.open) + (score.open == 1 ? " needs" : " need") +
                       " a rater; " + asked + ".");
}

void judgeGlobal(const GlobalRating* global, const Answers& grades, Verdict* v,
                 std::vector<std::string>* missing) {
  if (!global || grades.empty()) {
    missing->push_back("No global rating was given.");
    return;
  }
  int sum = 0, least = kBestGrade;
  for (const auto& [id, grade] : grades) sum += grade, least = std::min(least, grade);
  v->global_mean = static_cast<double>(sum) / static_cast<double>(grades.size());
  if (grades.size() < global->items.size())
    missing->push_back("The global rating leaves out " +
                       std::to_string(global->items.size() - grades.size()) + " of " +
                       std::to_string(global->items.size()) + " aspects.");
  else if (*v->global_mean < global->mean_at_least - 1e-9)
    v->reasons.push_back("Global rating: " + plain(*v->global_mean) + " of 5 on average; " +
                         plain(global->mean_at_least) + " is asked for.");
  if (least < global->none_below)
    v->reasons.push_back("Global rating: an aspect was graded " + std::to_string(least) +
                         "; none may be below " + std::to_string(global->none_below) + ".");
}

}  // namespace

const char* markWords(Mark mark) {
  switch (mark) {
    case Mark::done:
      return "done";
    case Mark::not_done:
      return "not done";
    case Mark::did_not_arise:
      return "did not arise";
    default:
      return "not judged";
  }
}

std::vector<MarkedItem> marked(const Checklist& checklist, const Figures& figures,
                               const Answers& rater) {
  std::vector<MarkedItem> all;
  for (const ChecklistItem& item : checklist.items)
    all.push_back(item.byRater() ? byRater(item, rater) : byFigures(item, figures, rater));
  return all;
}

ChecklistScore scoreOf(const std::vector<MarkedItem>& items) {
  ChecklistScore s;
  for (const MarkedItem& m : items) {
    s.done += m.mark == Mark::done;
    s.not_done += m.mark == Mark::not_done;
    s.did_not_arise += m.mark == Mark::did_not_arise;
    s.open += m.mark == Mark::open;
    const bool well = m.mark == Mark::done || m.mark == Mark::did_not_arise;
    (m.item->major ? s.major : s.minor) += 1;
    (m.item->major ? s.major_done : s.minor_done) += well;
  }
  const double all = s.done + s.not_done + s.open;
  if (all > 0) s.low = s.done / all, s.high = (s.done + s.open) / all;
  return s;
}

const char* levelOf(const ChecklistScore& score, const Checklist& checklist) {
  const auto reaches = [&](const Level& level) {
    return score.major_done >= level.major && score.minor_done >= level.minor;
  };
  return reaches(checklist.competent)    ? "competent"
         : reaches(checklist.borderline) ? "borderline"
                                         : "below borderline";
}

Verdict judge(const VerdictFacts& facts, const Checklist& checklist, const Figures& figures,
              const Answers& checklist_answers, const GlobalRating* global,
              const Answers& global_answers, double standard) {
  Verdict v;
  v.standard = standard;
  v.items = marked(checklist, figures, checklist_answers);
  v.score = scoreOf(v.items);
  v.level = levelOf(v.score, checklist);
  if (facts.outcome == training::Outcome::voided) {
    v.reasons = {"The trial was declared void: it is not judged."};
    return v;
  }
  std::vector<std::string> missing;
  judgeCritical(checklist, figures, &v, &missing);
  judgeChecklist(v.score, standard, &v, &missing);
  judgeGlobal(global, global_answers, &v, &missing);
  if (!facts.assessed)
    missing.push_back(
        "It was practice, where aids may be on; only a trial in assessment (--assess) can be "
        "passed.");
  v.status = !v.reasons.empty() ? Status::failed
             : !missing.empty() ? Status::not_certified
                                : Status::passed;
  v.reasons.insert(v.reasons.end(), missing.begin(), missing.end());
  return v;
}

const char* statusWords(Status status) {
  return status == Status::passed ? "Pass" : status == Status::failed ? "Fail" : "Not certified";
}

namespace {

std::string inPercent(double share) { return std::to_string(std::lround(100 * share)) + " %"; }

}  // namespace

std::vector<Certification> certifications() {
  std::vector<Certification> all;
  for (const auto& [acceptable, unacceptable] : {std::pair(0.10, 0.25), std::pair(0.10, 0.20),
                                                 std::pair(0.05, 0.15), std::pair(0.05, 0.10)}) {
    const statistics::CusumRates rates{acceptable, unacceptable, 0.1, 0.1};
    all.push_back({rates, statistics::cusumLimits(rates)});
  }
  return all;
}

std::string whatCannotBeCertified(int trials) {
  const std::vector<Certification> all = certifications();
  std::string within, beyond;
  const auto clause = [](const Certification& c) {
    return std::to_string(c.limits.shortest_clean_run) + " for a rate of failure of " +
           inPercent(c.rates.acceptable) + " against " + inPercent(c.rates.unacceptable);
  };
  for (const Certification& c : all)
    (c.limits.shortest_clean_run <= trials ? within : beyond) +=
        (((c.limits.shortest_clean_run <= trials ? within : beyond).empty()) ? "" : ", ") +
        clause(c);
  const std::string count = counted(trials, "trial");
  if (beyond.empty())
    return count + " without a failure are enough for every rate shown (" + within + ").";
  std::string words = count + " cannot certify anybody.";
  if (!within.empty())
    words =
        count + " without a failure are enough for some rates (" + within + ") and not for others.";
  words +=
      " The fewest trials in a row without a failure (sequential test, chances of error 0.1 "
      "each): " +
      beyond + ".";
  return words;
}

}  // namespace palpa::competence
