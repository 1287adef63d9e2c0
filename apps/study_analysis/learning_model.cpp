#include "apps/study_analysis/learning_model.h"

#include <cmath>

#include "anatomy/geometry/error.h"
#include "anatomy/random_stream.h"

namespace palpa::study_analysis {
namespace {

constexpr double kRate = 0.35;         // 1/trial [chosen]: nine tenths learned after seven trials
constexpr double kOwnShare = 1.0 / 3;  // of the variance between people [chosen]

double meanOfTwo(int trial) {
  return (std::exp(-kRate * (trial - 1)) + std::exp(-kRate * trial)) / 2;
}

/// A curve through the printed means of trials 1-2 and 9-10.
LearningCurve through(const char* group, const char* condition, double first, double last) {
  const double gain = (first - last) / (meanOfTwo(1) - meanOfTwo(9));
  return {group, condition, last - gain * meanOfTwo(9), gain, kRate};
}

LearningModel model(const char* metric, std::vector<LearningCurve> curves, double sd) {
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
    for (LearningCurve& c : m.curves) {
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
  anatomy::RandomStream random(seed);
  std::vector<StudyRow> rows;
  int person = 0;
  for (std::size_t cell = 0; cell < models[0].curves.size(); ++cell)
    for (int s = 0; s < subjects; ++s) {
      const std::string id = "S" + std::to_string(1000 + ++person).substr(1);
      std::vector<double> own;
      for (const LearningModel& m : models) own.push_back(m.subject_sd * random.normal());
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
          const LearningCurve& c = models[m].curves.at(cell);
          row.metrics[models[m].metric] = c.asymptote + c.gain * std::exp(-c.rate * (trial - 1)) +
                                          own[m] + models[m].residual_sd * random.normal();
        }
        rows.push_back(std::move(row));
      }
    }
  return rows;
}

}  // namespace palpa::study_analysis
