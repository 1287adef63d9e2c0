#include "apps/study_analysis/null_studies.h"

#include <boost/math/distributions/binomial.hpp>

#include "anatomy/geometry/error.h"
#include "apps/assess/statistics/t_test.h"
#include "apps/study_analysis/series.h"

namespace palpa::study_analysis {
namespace {

struct BothGroups {
  std::vector<Series> learners, experts;
};

BothGroups drawnSamples(const LearningModel& model, const DrawnStudies& drawn, int study) {
  const std::vector<Series> series =
      seriesOf(drawStudy({model}, drawn.subjects, drawn.trials,
                         drawn.seed + static_cast<std::uint64_t>(study)),
               model.metric);
  const LearningCurve& last = model.curves.back();
  return {within(series, model.curves.front().group, last.condition),
          within(series, last.group, last.condition)};
}

void require(const LearningModel& model, const DrawnStudies& drawn) {
  if (model.curves.size() < 2 || model.curves.front().group == model.curves.back().group)
    throw UsageError("the model needs two groups", "planning", "Give a curve for each");
  if (drawn.studies < 1 || drawn.subjects < 2 || drawn.trials < static_cast<int>(kTrialsToLearn))
    throw UsageError("needs a study, two subjects to a group and four trials", "planning",
                     "Ask for more");
}

}  // namespace

Detections detectionsIn(const LearningModel& model, const DrawnStudies& drawn) {
  require(model, drawn);
  Detections found;
  const auto below = [&](double p) { return p < drawn.level ? 1 : 0; };
  for (int study = 0; study < drawn.studies; ++study) {
    const BothGroups s = drawnSamples(model, drawn, study);
    const std::vector<Learning> learning = learningOf(s.learners);
    std::vector<double> first, last;
    for (const Learning& l : learning) {
      first.insert(first.end(), l.first_trials.begin(), l.first_trials.end());
      last.insert(last.end(), l.last_trials.begin(), l.last_trials.end());
    }
    ++found.studies;
    found.groups +=
        below(statistics::welch(subjectMeans(s.experts), subjectMeans(s.learners)).p_two_sided);
    found.learning += below(statistics::paired(lastOf(learning), firstOf(learning)).p_two_sided);
    found.groups_published +=
        below(statistics::welch(pooledTrials(s.experts), pooledTrials(s.learners)).p_less);
    found.learning_published += below(statistics::welch(last, first).p_less);
  }
  return found;
}

Band binomialBand(int studies, double level) {
  const boost::math::binomial distribution(studies, level);
  return {static_cast<int>(boost::math::quantile(distribution, 0.025)),
          static_cast<int>(boost::math::quantile(distribution, 0.975))};
}

}  // namespace palpa::study_analysis
