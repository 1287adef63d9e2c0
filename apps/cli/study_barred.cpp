#include "apps/cli/study_participant.h"
#include "apps/task_needle/task_file.h"
#include "calibration/expert_path.h"

namespace palpa::cli {
namespace {

void addExpertsOf(const study::Block& block,
                  std::vector<std::pair<std::string, std::string>>* barred) {
  if (block.engine != "needle") return;
  const task_needle::TaskSettings task = task_needle::readTask(block.task);
  if (task.expert_path.empty()) return;
  for (const std::string& expert : calibration::readExpertPath(task.expert_path).experts)
    barred->emplace_back(expert, "made the optimal path that this study is judged by (" +
                                     task.expert_path.string() + ")");
}

}  // namespace

std::vector<std::pair<std::string, std::string>> barredFrom(const study::Protocol& protocol) {
  std::vector<std::pair<std::string, std::string>> barred;
  for (const std::string& trainee : protocol.barred)
    barred.emplace_back(trainee, "is barred by the protocol");
  if (!protocol.bars_experts) return barred;
  for (const study::Session& session : protocol.sessions)
    for (const study::Block& block : session.blocks) addExpertsOf(block, &barred);
  return barred;
}

}  // namespace palpa::cli
