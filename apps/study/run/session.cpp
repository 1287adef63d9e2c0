#include "apps/study/run/session.h"

#include <algorithm>
#include <cstdio>
#include <iostream>
#include <optional>

#include "anatomy/base/error.h"
#include "anatomy/base/json_file.h"
#include "anatomy/base/uuid.h"
#include "apps/training/engine.h"

namespace palpa::study {
namespace {

namespace fs = std::filesystem;

constexpr std::uint64_t kSeedsOfStep = 10'000;  // more than a block can have trials

void present(const study::Setting& p, session::SessionOptions* o) {
  o->force_feedback = p.force_feedback;
  o->presentation = p.presentation;
  o->hide_forces = p.hide_forces;
  o->augment = p.augment;
  o->skin_deflection = p.skin_deflection;
  o->guide = p.guide;
  o->guidance = p.guidance;
  o->navigation = p.navigation;
  o->mode = p.mode;
}

}  // namespace

session::SessionOptions studySession(const session::SessionOptions& place,
                                     const study::Protocol& protocol,
                                     const record::Enrolment& enrolment, const study::Next& next) {
  const study::Block& block = protocol.block(next.step);
  session::SessionOptions o = place;
  o.command = training::commandOf(block.engine);
  o.task = block.task.string();
  o.trainee = enrolment.trainee;
  o.role = block.role;
  o.trials = next.trials;
  o.seed = protocol.trial_seed + kSeedsOfStep * static_cast<std::uint64_t>(block.step) +
           static_cast<std::uint64_t>(next.done);
  o.demonstration = o.familiarisation = false;
  present(protocol.condition(next.condition)->shows, &o);
  o.uuid = newUuid();
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

namespace {

const study::Item& itemOf(const study::Questionnaire& questionnaire, const std::string& id) {
  return *std::find_if(questionnaire.items.begin(), questionnaire.items.end(),
                       [&](const study::Item& item) { return item.id == id; });
}

void show(const study::Item& item, std::size_t number, std::size_t of) {
  std::printf("\n%zu of %zu. %s\n", number, of, item.question.c_str());
  if (item.kind == study::ItemKind::likert)
    std::printf("   1 %s ... %d %s\n", item.low.c_str(), item.points, item.high.c_str());
  if (item.may_be_left) std::printf("   (Enter leaves it out)\n");
}

/// None at the input's end.
std::optional<std::string> readAnswer(const study::Item& item) {
  for (std::string line;;) {
    std::printf("> ");
    std::fflush(stdout);
    if (!std::getline(std::cin, line)) return std::nullopt;
    const std::string why = study::whyNoAnswer(item, line);
    if (why.empty()) return line;
    std::printf("   %s\n", why.c_str());
  }
}

std::string textOf(const nlohmann::json& answer) {
  return answer.is_string() ? answer.get<std::string>() : answer.dump();
}

}  // namespace

bool askQuestions(const study::Questionnaire& questionnaire, const study::Next& next,
                  StudyParticipant& participant) {
  std::printf("\n%s\n", questionnaire.title.c_str());
  for (const std::string& id : next.open_items) {
    const study::Item& item = itemOf(questionnaire, id);
    show(item, static_cast<std::size_t>(&item - questionnaire.items.data()) + 1,
         questionnaire.items.size());
    const std::optional<std::string> answer = readAnswer(item);
    if (!answer) return false;
    participant.answer(next.session, id, *answer);
  }
  return true;
}

bool takeAnswers(const std::string& path, const study::Questionnaire& questionnaire,
                 const study::Next& next, StudyParticipant& participant) {
  const JsonFile file(path);
  if (!file.json().is_object()) file.refuse("", "must be items and answers");
  for (const auto& field : file.json().items()) {
    const std::string& id = field.key();
    const nlohmann::json& answer = field.value();
    const auto item = std::find_if(questionnaire.items.begin(), questionnaire.items.end(),
                                   [&](const study::Item& i) { return i.id == id; });
    if (item == questionnaire.items.end())
      file.refuse(id, "is not an item of the questionnaire \"" + questionnaire.id + "\"");
    if (const std::string why = study::whyNoAnswer(*item, textOf(answer)); !why.empty())
      file.refuse(id, "cannot be accepted: " + why);
  }
  std::size_t taken = 0;
  for (const std::string& id : next.open_items)
    if (file.has(id)) {
      participant.answer(next.session, id, textOf(file.json().at(id)));
      ++taken;
    }
  return taken == next.open_items.size();
}

}  // namespace palpa::study
