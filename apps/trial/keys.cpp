#include "apps/trial/keys.h"

#include "scene/key_places.h"

namespace palpa::trial {
namespace {

using scene::KeyHelp;
using training::Engine;

constexpr const char* kVoidReasons[] = {"interrupted", "technical fault", "trainee stopped",
                                        "other"};

void send(Channels& channels, UserCommand command, const std::string& reason = "") {
  channels.requests_to_task.push({command, reason});
}

/// What a trainee says.
std::vector<KeyHelp> saidIn(Engine engine) {
  switch (engine) {
    case Engine::palpation:
      return {{"[M]", "here is a lump (a device: its button)"},
              {"1, 2", "it is soft, hard"},
              {"3, 4", "it is fixed, mobile"},
              {"5, 6, 7, 8", "it is 10, 15, 20, 25 mm large"},
              {"[D]", "done"}};
    case Engine::squeeze:
    case Engine::friction:
      return {{"1, 2, ...", "the answer: which one"}, {"[D]", "the next one, or done"}};
    case Engine::pulse:
      return {{"[M]", "here is the pulse (a device: its button)"},
              {"0 to 9", "the count; then 1, 2, 3 for the rhythm"},
              {"[D]", "begins the count, says the number"}};
    case Engine::search:
      return {{"nothing", "stay in the middle of the rough one: that chooses it"}};
    case Engine::needle:
      return {{"1, 2, 3", "when it is asked: vein, artery, neither"}};
  }
  return {};
}

std::vector<KeyHelp> movedBy(HeldBy held, bool left_handed) {
  switch (held) {
    case HeldBy::mouse_needle:
      return {{"drag", "moves the needle over the skin"},
              {"wheel", "moves it along itself, in and out"},
              {"arrows", "turn it about its entry"},
              {left_handed ? "[.], [,]" : "[Z], [X]", "draw the plunger, push it"}};
    case HeldBy::mouse_finger:
      return {{"mouse", "moves the finger; hold the left button to press"}};
    case HeldBy::device:
      break;
  }
  return {};
}

std::vector<KeyHelp> ofEverySession() {
  return {{"Enter", "starts, continues"},
          {"[P]", "pauses"},
          {"[A]", "ends the trial without a result"},
          {"F5 to F8", "void: interrupted, technical fault, trainee stopped, other"},
          {"Space", "EMERGENCY STOP: forces are off"},
          {"[R]", "re-arms after it"},
          {"F11", "full screen, and back"},
          {"Escape, twice", "ends the session"}};
}

void append(std::vector<KeyHelp>& all, const std::vector<KeyHelp>& more) {
  all.insert(all.end(), more.begin(), more.end());
}

}  // namespace

void handleKeys(const scene::ViewInput& input, Channels& channels, runtime::StopSwitch& stop) {
  if (input.closed) send(channels, UserCommand::quit);
  for (const std::string& key : input.keys) {
    if (key == "Return" || key == "KP_Enter")
      send(channels, UserCommand::start);
    else if (key == "p")
      send(channels, UserCommand::pause);
    else if (key == "a")
      send(channels, UserCommand::abort);
    else if (key == "space")
      stop.press();
    else if (key == "r")
      send(channels, UserCommand::rearm);
    else if (key == "Escape")
      send(channels, UserCommand::escape);
    else if (key == "d")
      send(channels, UserCommand::done);
    else if (key.size() == 1 && key[0] >= '0' && key[0] <= '9')
      send(channels, UserCommand::choose, key);
    else if (key.size() == 2 && (key[0] == 'F') && key[1] >= '5' && key[1] <= '8')
      send(channels, UserCommand::void_trial, kVoidReasons[key[1] - '5']);
  }
}

std::vector<KeyHelp> keysOf(const KeysInUse& use) {
  std::vector<KeyHelp> all = movedBy(use.held, use.left_handed);
  append(all, saidIn(use.engine));
  if (use.free_skin) all.push_back({"[T]", "the skin: clear, solid, gone"});
  if (use.one_fixed_view) all.push_back({"[V]", "the next fixed view"});
  if (use.sound) all.push_back({"[S]", "the sound: off, and on"});
  append(all, ofEverySession());
  return all;
}

std::string movedWords(HeldBy held, bool left_handed) {
  switch (held) {
    case HeldBy::mouse_needle:
      return std::string("Drag: over the skin. Arrows: turn. Wheel: in and out. ") +
             (left_handed ? "[.]" : "[Z]") + ": draw the plunger";
    case HeldBy::mouse_finger:
      return "Mouse: moves the finger. Left button: presses";
    case HeldBy::device:
      break;
  }
  return "";
}

std::string keysText(Engine engine) {
  std::string text;
  for (const KeyHelp& one :
       keysOf({.engine = engine, .free_skin = true, .one_fixed_view = true, .sound = true}))
    text += (text.empty() ? "Keys: " : "; ") + one.key + ": " + one.words;
  return scene::withKeys(text, {}) + "; ? or F1: shows these in the window";
}

}  // namespace palpa::trial
