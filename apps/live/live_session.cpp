#include "apps/live/live_session.h"

#include <algorithm>

#include "apps/live/live_sink.h"
#include "apps/live/wire.h"
#include "apps/training/trial_words.h"

namespace palpa::live {
namespace {

constexpr std::int64_t kWords = 200'000'000, kPicture = 66'000'000;  // ns
constexpr int kLoggedRefusals = 1000;

const char* nameOf(trial::TrialState state) {
  using trial::TrialState;
  switch (state) {
    case TrialState::checking:
      return "checking";
    case TrialState::waiting:
      return "waiting";
    case TrialState::running:
      return "running";
    case TrialState::paused:
      return "paused";
    case TrialState::ended:
      return "ended";
    case TrialState::finished:
      return "finished";
  }
  return "";
}

std::string helloEntry(const Hello& hello) {
  return entryOf({{"kind", "hello"},
                  {"uuid", hello.uuid},
                  {"task", hello.task},
                  {"trainee", hello.trainee},
                  {"simulated", hello.simulated},
                  {"assessed", hello.assessed},
                  {"trials", hello.trials}});
}

LiveLog& beginWith(LiveLog& log, const Hello& hello) {
  log.add(helloEntry(hello));
  return log;
}

}  // namespace

LiveSession::LiveSession(const std::string& socket, const Hello& hello, trial::Channels& channels,
                         runtime::StopSwitch& stop)
    : channels_(channels),
      stop_(stop),
      port_(socket, beginWith(log_, hello),
            [this](const std::string& command) { receive(command); }),
      stop_port_(stopSocketOf(socket), [this] { stop_.press(); }) {}

void LiveSession::show(const scene::Hud& hud, const trial::TrialStatus& status,
                       std::int64_t now_ns) {
  if (now_ns < next_words_ns_) return;
  next_words_ns_ = now_ns + kWords;
  nlohmann::json words{
      {"kind", "status"},
      {"state", nameOf(status.state)},
      {"trial", status.trial},
      {"trials", status.trials},
      {"role", training::nameOf(status.role)},
      {"notice", hud.notice},
      {"alarm", hud.alarm},
      {"emergency_stop", status.emergency_stop},
      {"phase", hud.phase},
      {"depth", hud.depth},
      {"force", hud.force},
      {"touched", hud.touched},
      {"elapsed_s", static_cast<double>(static_cast<int>(10 * status.elapsed_s)) / 10}};
  std::string now = entryOf(words);
  if (now == published_) return;
  published_ = std::move(now);
  words["t_s"] = secondsOf(now_ns);
  log_.addPassing(entryOf(words), static_cast<std::uint32_t>(status.trial));
}

void LiveSession::picture(scene::Image picture, std::int64_t now_ns) {
  next_picture_ns_ = now_ns + kPicture;
  port_.offer(std::move(picture));
}

void LiveSession::receive(const std::string& command) {
  try {
    const trial::UserRequest request = parseSteering(command);
    if (request.command == trial::UserCommand::emergency_stop) return stop_.press();
    channels_.console_to_task.push(request);
  } catch (const Error& e) {
    if (++refused_ <= kLoggedRefusals) log_.add(entryOf({{"kind", "refused"}, {"text", e.what()}}));
  }
}

}  // namespace palpa::live
