#include "apps/cli/study_session.h"

#include "apps/record/uuid.h"

namespace palpa::cli {
namespace {

namespace fs = std::filesystem;

constexpr std::uint64_t kSeedsOfStep = 10'000;  // more than a block can have trials

std::string commandOf(const std::string& engine) {
  return engine == "surface" ? "search" : engine == "needle" ? "paracentesis" : engine;
}

void present(const study::Presentation& p, SessionOptions* o) {
  o->force_feedback = p.force_feedback;
  o->augment = p.augment;
  o->skin_deflection = p.skin_deflection;
  o->guide = p.guide;
  o->guidance = p.guidance;
  o->navigation = p.navigation;
  o->mode = p.mode;
}

}  // namespace

SessionOptions studySession(const SessionOptions& place, const study::Protocol& protocol,
                            const record::Enrolment& enrolment, const study::Next& next) {
  const study::Block& block = protocol.block(next.step);
  SessionOptions o = place;
  o.command = commandOf(block.engine);
  o.task = block.task.string();
  o.trainee = enrolment.trainee;
  o.role = block.role;
  o.trials = next.trials;
  o.seed = protocol.trial_seed + kSeedsOfStep * static_cast<std::uint64_t>(block.step) +
           static_cast<std::uint64_t>(next.done);
  o.demonstration = o.familiarisation = false;
  present(protocol.condition(next.condition)->shows, &o);
  o.uuid = record::newUuid();
  o.study = {protocol.id, block.step,    enrolment.group, next.condition,
             block.name,  next.done + 1, protocol.sha256};
  return o;
}

fs::path studyFolder(const std::string& out, const study::Protocol& protocol,
                     const std::string& trainee, const study::Next& next) {
  const fs::path base = out.empty() ? fs::path("out") / ("study-" + protocol.id) : fs::path(out);
  const std::string name = std::to_string(next.step) + "-" + protocol.block(next.step).name +
                           (next.done ? "-" + std::to_string(next.done + 1) : "");
  fs::path folder = base / trainee / name;
  for (int again = 2; fs::exists(folder); ++again)
    folder = base / trainee / (name + "-again" + std::to_string(again));
  return folder;
}

}  // namespace palpa::cli
