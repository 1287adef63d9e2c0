#include "apps/evidence/rating_forms.h"

#include <cmath>

#include "anatomy/base/error.h"
#include "anatomy/base/sha256.h"
#include "anatomy/base/whole_file.h"
#include "apps/station/assets.h"
#include "apps/training/trial_words.h"

namespace palpa::evidence {

std::string textOf(const std::filesystem::path& file) {
  const std::optional<std::string> text = readWhole(file);
  if (!text) throw UsageError("cannot be read", file.string(), "Check the path");
  // a mark that spreadsheets put before UTF-8
  return text->starts_with("\xEF\xBB\xBF") ? text->substr(3) : *text;
}

RatingForms readForms(const std::string& checklist, const std::string& global) {
  const std::filesystem::path list = checklist.empty()
                                         ? station::assetFile("checklists/subclavian.json")
                                         : std::filesystem::path(checklist),
                              rating = global.empty()
                                           ? station::assetFile("checklists/global_rating.json")
                                           : std::filesystem::path(global);
  RatingForms forms{competence::parseChecklist(textOf(list), list.string()),
                    competence::parseGlobalRating(textOf(rating), rating.string()),
                    sha256OfFile(list), sha256OfFile(rating)};
  for (const competence::RatingItem& aspect : forms.global.items)
    for (const competence::ChecklistItem& item : forms.checklist.items)
      if (item.id == aspect.id)
        throw UsageError("both have \"" + item.id + "\", so that an answer could belong to either",
                         list.string() + ", " + rating.string(), "Rename one of them");
  return forms;
}

double standardOf(const competence::Checklist& checklist, double percent) {
  if (percent == 0) return checklist.standards.front();
  std::string known;
  for (const double standard : checklist.standards) {
    if (std::abs(100 * standard - percent) < 1e-6) return standard;
    known += (known.empty() ? "" : ", ") + std::to_string(std::lround(100 * standard));
  }
  throw UsageError("is not a standard of this checklist", "--standard", "Known: " + known);
}

competence::FormAnswers answersIn(const std::vector<record::Rating>& ratings, std::int64_t trial,
                                  const std::string& rater, const RatingForms& forms) {
  competence::FormAnswers answers;
  for (const record::Rating& r : ratings) {
    if (r.number != trial || r.rater != rater) continue;
    const bool of_list = r.form == forms.checklist.id;
    if (!of_list && r.form != forms.global.id) continue;
    if (r.form_sha256 != (of_list ? forms.checklist_sha256 : forms.global_sha256))
      throw UsageError(
          "was rated by " + rater + " on another edition of the form \"" + r.form + "\"",
          "trial " + std::to_string(trial), "Give that edition with --checklist and --global");
    (of_list ? answers.checklist : answers.global)[r.item] = static_cast<int>(r.value);
  }
  return answers;
}

competence::Figures figuresOf(const assess::TrialAssessment& assessment) {
  return [&assessment](const std::string& name) -> std::optional<double> {
    for (const metrics::MetricValue& m : assessment.metrics)
      if (m.name == name) return m.value;
    return std::nullopt;
  };
}

competence::Figures figuresOf(const record::StoredTrial& trial) {
  return [&trial](const std::string& name) -> std::optional<double> {
    for (const record::Metric& m : trial.metrics)
      if (m.name == name) return m.value;
    return std::nullopt;
  };
}

competence::Verdict verdictOf(const assess::TrialAssessment& a, const RatingForms& forms,
                              const competence::FormAnswers& answers, double standard) {
  return competence::judge({training::inAssessment(a.role), a.outcome}, forms.checklist,
                           figuresOf(a), answers.checklist, &forms.global, answers.global,
                           standard);
}

}  // namespace palpa::evidence
