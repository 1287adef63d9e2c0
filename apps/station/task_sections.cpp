#include "apps/station/task_sections.h"

#include <array>
#include <cmath>
#include <numeric>
#include <utility>
#include <vector>

#include "apps/station/calibration_file.h"

namespace palpa::station {

Taxonomy taxonomyOf(const JsonFile& task) {
  return {task.text("taxonomy/visual"), task.text("taxonomy/haptic"), task.text("taxonomy/purpose"),
          task.text("taxonomy/property")};
}

std::string briefOf(const JsonFile& task) {
  constexpr std::size_t kMost = 90;  // letters
  if (!task.has("brief")) return "";
  std::string brief = task.text("brief");
  if (brief.size() > kMost) task.refuse("brief", "is longer than 90 letters");
  return brief;
}

namespace {

using haptics::LearnedModel;
using nlohmann::json;

constexpr const char* kLearned = "learned";
constexpr std::array<const char*, haptics::kLearnedFeatures> kFeatures{"log_speed", "log_force",
                                                                       "in_contact", "log_shaking"};
constexpr std::array<std::pair<const char*, double>, 4> kSteps{
    {{"step_s", 1e-9 * static_cast<double>(haptics::kLearnedStep_ns)},
     {"least_speed_m_per_s", haptics::kLeastSpeed},
     {"least_force_N", haptics::kLeastForce_N},
     {"least_shaking_N", haptics::kLeastShaking_N}}};

/// What the tick needs of a calibration, under its names there.
json modelOf(const CalibrationFile& file, const std::string& from) {
  json model{{"from", from}};
  for (const CalibrationFile::Numbers& p : file.parameters) {
    bool wanted =
        p.name == "states" || p.name == "start" || p.name.rfind("move_from_state_", 0) == 0;
    for (const auto& [name, value] : kSteps) wanted |= p.name == name;
    for (const char* feature : kFeatures)
      wanted |=
          p.name == std::string("mean_") + feature || p.name == std::string("variance_") + feature;
    if (wanted) model[p.name] = p.values.size() == 1 ? json(p.values.front()) : json(p.values);
  }
  return model;
}

std::string fieldOf(const std::string& name) { return std::string(kLearned) + "/" + name; }

/// A list of `count` numbers.
std::vector<double> numbersIn(const JsonFile& task, const std::string& name, std::size_t count,
                              double low, double high) {
  const std::string field = fieldOf(name);
  const json* values =
      task.json().at(kLearned).contains(name) ? &task.json().at(kLearned).at(name) : nullptr;
  if (!values || !values->is_array() || values->size() != count)
    task.refuse(field, "must be a list of " + std::to_string(count) + " numbers");
  std::vector<double> numbers;
  for (const json& value : *values) {
    if (!value.is_number() || !(value.get<double>() >= low && value.get<double>() <= high))
      task.refuse(field, "holds " + value.dump() + ", which cannot be");
    numbers.push_back(value.get<double>());
  }
  return numbers;
}

std::vector<double> sharesIn(const JsonFile& task, const std::string& name, std::size_t count) {
  constexpr double kRounding = 1e-6;
  std::vector<double> shares = numbersIn(task, name, count, 0, 1);
  if (std::abs(std::accumulate(shares.begin(), shares.end(), -1.0)) > kRounding)
    task.refuse(fieldOf(name), "does not add up to 1");
  return shares;
}

/// A feature that was not used tells no state from another.
void readFeature(const JsonFile& task, std::size_t feature, LearnedModel* model) {
  constexpr double kLargest = 1e6, kLeast = 1e-12;
  const std::string name = kFeatures[feature];
  const bool used = task.has(fieldOf("mean_" + name));
  if (used != task.has(fieldOf("variance_" + name)))
    task.refuse(fieldOf("mean_" + name), "and its variance go together");
  const auto means = used ? numbersIn(task, "mean_" + name, model->states, -kLargest, kLargest)
                          : std::vector<double>(model->states, 0);
  const auto variances = used ? numbersIn(task, "variance_" + name, model->states, kLeast, kLargest)
                              : std::vector<double>(model->states, 1);
  for (std::size_t k = 0; k < model->states; ++k) {
    model->mean[k][feature] = means[k];
    model->variance[k][feature] = variances[k];
  }
}

}  // namespace

JsonFile readTaskFile(const std::filesystem::path& path) {
  JsonFile file(path);
  if (!file.json().is_object() || !file.json().contains(kLearned) ||
      !file.json().at(kLearned).is_string())
    return file;
  const std::filesystem::path named = path.parent_path() / file.text(kLearned);
  const CalibrationFile learned = readCalibration(named);
  if (learned.kind != CalibrationKind::subtasks)
    file.refuse(kLearned, "names a calibration of kind \"" + nameOf(learned.kind) +
                              "\"; palpa calibrate subtasks makes the one that is needed");
  if (!learned.passed()) file.refuse(kLearned, "names parts that did not pass: " + learned.verdict);
  json task = file.json();
  task[kLearned] = modelOf(learned, named.filename().string());
  return {std::move(task), file.name()};
}

LearnedModel learnedIn(const JsonFile& task) {
  LearnedModel model;
  if (!task.has(kLearned)) return model;
  if (!task.json().at(kLearned).is_object()) task.refuse(kLearned, "is not a model");
  for (const auto& [name, value] : kSteps)
    if (std::abs(task.number(fieldOf(name)) / value - 1) > 1e-9)
      task.refuse(fieldOf(name), "differs from this program's: learn the parts again");
  model.states =
      static_cast<std::uint32_t>(task.integer(fieldOf("states"), 2, haptics::kMostLearnedStates));
  const auto fill = [](const std::vector<double>& from,
                       std::array<double, haptics::kMostLearnedStates>* to) {
    std::copy(from.begin(), from.end(), to->begin());
  };
  fill(sharesIn(task, "start", model.states), &model.start);
  for (std::size_t k = 0; k < model.states; ++k)
    fill(sharesIn(task, "move_from_state_" + std::to_string(k + 1), model.states),
         &model.transition[k]);
  for (std::size_t feature = 0; feature < kFeatures.size(); ++feature)
    readFeature(task, feature, &model);
  return model;
}

}  // namespace palpa::station
