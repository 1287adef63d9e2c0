#include "apps/study/analysis/power_analysis.h"

#include <cmath>

#include <boost/math/distributions/binomial.hpp>

#include "anatomy/base/error.h"
#include "anatomy/base/random.h"
#include "apps/assess/statistics/tests_of_means.h"
#include "apps/study/analysis/series.h"

namespace palpa::study_analysis {
namespace {

constexpr double kRate = 0.35;         // 1/trial [chosen]: nine tenths learned after seven trials
constexpr double kOwnShare = 1.0 / 3;  // of the variance between people [chosen]

double meanOfTwo(int trial) {
  return (std::exp(-kRate * (trial - 1)) + std::exp(-kRate * trial)) / 2;
}

/// A curve through the printed means of trials 1-2 and 9-10.
AssumedLearning through(const char* group, const char* condition, double first, double last) {
  const double gain = (first - last) / (meanOfTwo(1) - meanOfTwo(9));
  return {group, condition, last - gain * meanOfTwo(9), gain, kRate};
}

LearningModel model(const char* metric, std::vector<AssumedLearning> curves, double sd) {
  return {metric, std::move(curves), sd * std::sqrt(kOwnShare), sd * std::sqrt(1 - kOwnShare)};
}

}  // namespace

std::vector<LearningModel> pilotModels() {
  return {model("time_s",
                {through("novice", "NO", 71.5, 55.2),
                 through("novice", "FF", 89.9, 46.3),
                 {"experienced", "NO", 53.4, 0, kRate},
                 {"experienced", "FF", 32.7, 0, kRate}},
                27),
          model("total",
                {through("novice", "NO", 1918.99, 1223.76),
                 through("novice", "FF", 1636.37, 859.32),
                 {"experienced", "NO", 1580, 0, kRate},
                 {"experienced", "FF", 753, 0, kRate}},
                600)};
}

std::vector<LearningModel> nullModels() {
  std::vector<LearningModel> models = pilotModels();
  for (LearningModel& m : models)
    for (AssumedLearning& c : m.curves) {
      c.asymptote = m.curves[0].asymptote;
      c.gain = 0;
    }
  return models;
}

std::vector<StudyRow> drawStudy(const std::vector<LearningModel>& models, int subjects, int trials,
                                std::uint64_t seed) {
  if (models.empty() || subjects < 1 || trials < 1)
    throw UsageError("a drawn study needs a model, subjects and trials", "learning model",
                     "Ask for at least one of each");
  RandomStream random = RandomStream::ofSeed(seed);
  std::vector<StudyRow> rows;
  int person = 0;
  for (std::size_t cell = 0; cell < models[0].curves.size(); ++cell)
    for (int s = 0; s < subjects; ++s) {
      const std::string id = "S" + std::to_string(1000 + ++person).substr(1);
      std::vector<double> own;
      for (const LearningModel& m : models) own.push_back(m.subject_sd * random.openNormal());
      for (int trial = 1; trial <= trials; ++trial) {
        StudyRow row{id,
                     models[0].curves[cell].group,
                     models[0].curves[cell].condition,
                     "trials",
                     1,
                     trial,
                     trial,
                     true,
                     "",
                     {}};
        for (std::size_t m = 0; m < models.size(); ++m) {
          const AssumedLearning& c = models[m].curves.at(cell);
          row.metrics[models[m].metric] = c.asymptote + c.gain * std::exp(-c.rate * (trial - 1)) +
                                          own[m] + models[m].residual_sd * random.openNormal();
        }
        rows.push_back(std::move(row));
      }
    }
  return rows;
}

namespace {

struct BothGroups {
  std::vector<SubjectSeries> learners, experts;
};

BothGroups drawnSamples(const LearningModel& model, const DrawnStudies& drawn, int study) {
  const std::vector<SubjectSeries> series =
      seriesOf(drawStudy({model}, drawn.subjects, drawn.trials,
                         drawn.seed + static_cast<std::uint64_t>(study)),
               model.metric);
  const AssumedLearning& last = model.curves.back();
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
