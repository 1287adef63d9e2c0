#include "apps/trial/trial_status.h"

#include <cmath>
#include <cstdio>
#include <filesystem>

namespace palpa::trial {

std::string endNotice(training::Role role, training::Outcome outcome, const std::string& result,
                      const std::string& reason) {
  using training::Outcome;
  const bool broken_off = outcome == Outcome::aborted || outcome == Outcome::voided;
  if (training::inAssessment(role) && !broken_off)
    return "Trial ended. The report gives the result";
  if (outcome == Outcome::success || outcome == Outcome::done) return result;
  return reason.empty() ? "Trial ended: " + training::nameOf(outcome) : "Trial ended. " + reason;
}

namespace {

constexpr char kBetween[] = ": ";

}  // namespace

std::string pictureFile(const PictureRequest& request) {
  char before[32];
  std::snprintf(before, sizeof before, "view-%02d-%02d-", request.trial, request.number);
  return before + request.label + ".png";
}

std::string pictureText(const PictureRequest& request) {
  return pictureFile(request) + kBetween + request.caption;
}

PictureInWords pictureIn(const std::string& text) {
  const std::size_t at = text.find(kBetween);
  if (at == std::string::npos) return {};
  return {std::filesystem::path(text.substr(0, at)).filename().string(),
          text.substr(at + sizeof kBetween - 1)};
}

std::string gradeText(double diameter, int hardness, int mobility) {
  std::string text;
  const auto add = [&text](const std::string& words) {
    text += (text.empty() ? "" : ", ") + words;
  };
  if (diameter > 0) add("diameter " + std::to_string(std::lround(1e3 * diameter)) + " mm");
  if (hardness > 0) add(hardness == 1 ? "soft" : "hard");
  if (mobility > 0) add(mobility == 1 ? "fixed" : "mobile");
  return text;
}

Grade gradeOf(const std::string& text) {
  Grade grade;
  double mm = 0;
  if (const auto at = text.find("diameter ");
      at != std::string::npos && std::sscanf(text.c_str() + at, "diameter %lf mm", &mm) == 1 &&
      mm > 0 && mm < 1000)
    grade.diameter = 1e-3 * mm;
  const auto says = [&](const char* word) { return text.find(word) != std::string::npos; };
  grade.hardness = says("soft") ? 1 : says("hard") ? 2 : 0;
  grade.mobility = says("fixed") ? 1 : says("mobile") ? 2 : 0;
  return grade;
}

Grade gradeOf(const UserRequest& request) {
  constexpr const char* kKeys[] = {"soft",           "hard",           "fixed",
                                   "mobile",         "diameter 10 mm", "diameter 15 mm",
                                   "diameter 20 mm", "diameter 25 mm"};
  const std::string& said = request.reason;
  if (request.command == UserCommand::grade) return gradeOf(said);
  if (request.command != UserCommand::choose || said.size() != 1 || said[0] < '1' || said[0] > '8')
    return {};
  return gradeOf(kKeys[said[0] - '1']);
}

}  // namespace palpa::trial
