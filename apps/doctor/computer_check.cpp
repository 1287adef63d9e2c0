#include "apps/doctor/computer_check.h"

#include <algorithm>
#include <clocale>
#include <cmath>
#include <cstdlib>
#include <thread>

#include <nlohmann/json.hpp>

#include "anatomy/base/error.h"
#include "anatomy/base/fonts.h"
#include "anatomy/base/json_text.h"
#include "anatomy/base/whole_file.h"
#include "apps/doctor/finding.h"
#include "apps/os/file_access.h"
#include "apps/os/real_time.h"
#include "apps/os/system_time.h"
#include "apps/runtime/clock.h"
#include "apps/station/assets.h"

namespace palpa::doctor {
namespace {

namespace fs = std::filesystem;

constexpr std::uint64_t kMegabyte = 1'000'000;
constexpr std::uint64_t kLeast = 200 * kMegabyte,
                        kComfortable = 2000 * kMegabyte;  // a trial leaves some 10 MB

constexpr const char* kPermit =
    "Ask whoever looks after the computer: as root write \"@audio - rtprio 90\" and \"@audio - "
    "memlock unlimited\" into /etc/security/limits.d/palpa.conf, add this user to the group audio, "
    "log in again";

std::string environment(const char* name) {
  const char* value = std::getenv(name);
  return value ? value : "";
}

/// The nearest folder that exists.
fs::path existing(fs::path folder) {
  std::error_code none;
  folder = fs::absolute(folder, none);
  while (!fs::exists(folder, none) && folder.has_parent_path() && folder != folder.parent_path())
    folder = folder.parent_path();
  return folder;
}

}  // namespace

LoopFacts measureLoop() {
  LoopFacts facts;
  const os::MemoryLock lock;
  facts.memory = lock.words();
  std::thread([&facts] {
    constexpr int kSteps = 1000;
    facts.priority = os::becomeRealTime(-1);
    const runtime::SteadyClock clock;
    std::vector<std::int64_t> late;
    const std::int64_t begun = clock.now();
    for (int i = 1; i <= kSteps; ++i) {
      const std::int64_t due = begun + i * runtime::kMillisecond;
      clock.sleepUntil(due);
      late.push_back(clock.now() - due);
    }
    facts.rate_Hz = kSteps / (1e-9 * static_cast<double>(clock.now() - begun));
    std::sort(late.begin(), late.end());
    facts.late_99_us = 1e-3 * static_cast<double>(late[kSteps * 99 / 100]);
  }).join();
  return facts;
}

Finding judgeLoop(const LoopFacts& facts, bool needed) {
  constexpr double kLate_us = 500;  // half a step of 1 kHz
  constexpr const char* kForces = "forces (haptic loop)";
  const std::string measured =
      text("%.0f steps a second, 99 of 100 within %.0f us", facts.rate_Hz, facts.late_99_us);
  if (!needed) return {kForces, State::well, "enough for the virtual bench: " + measured};
  const bool refused = facts.priority.rfind("SCHED_FIFO", 0) != 0;
  if (facts.rate_Hz < 900 || facts.late_99_us > kLate_us)
    return {kForces, State::note, "they will stutter: " + measured,
            refused ? std::string(kPermit) + "; and close other programs"
                    : "Close other programs; on a laptop plug in the power supply"};
  if (refused)
    return {kForces, State::note,
            "they may stutter when the computer is busy: " + measured + ", but at normal priority",
            kPermit};
  if (facts.memory.find("not locked") != std::string::npos)
    return {kForces, State::note,
            "they may stutter: " + measured + ", but its memory may be put out to disk", kPermit};
  return {kForces, State::well, "steady: " + measured + ", in real time"};
}

DiskFacts measureDisk(const fs::path& folder) {
  DiskFacts facts{existing(folder), true, 0};
  std::error_code failed;
  const fs::space_info space = fs::space(facts.folder, failed);
  facts.free_bytes = failed ? 0 : space.available;
  facts.writable = os::mayWrite(facts.folder);
  return facts;
}

Finding judgeDisk(const DiskFacts& facts) {
  const std::string place = facts.folder.string();
  if (!facts.writable)
    return {"disk", State::ill, place + " may not be written by this user",
            "Start in a folder of your own, or say where results go: --out"};
  const std::string free =
      text("%.1f GB free", 1e-9 * static_cast<double>(facts.free_bytes)) + " in " + place;
  if (facts.free_bytes < kLeast)
    return {"disk", State::ill, free,
            "Free the disk: a session leaves some 10 MB a trial, and needs room to end in order"};
  if (facts.free_bytes < kComfortable)
    return {"disk", State::note,
            free + ": enough for some " +
                text("%.0f trials",
                     static_cast<double>(facts.free_bytes - kLeast) / (10.0 * kMegabyte)),
            "Free the disk before a course"};
  return {"disk", State::well, free};
}

Finding judgeLetters(const fs::path& root) {
  for (const char* letter : {"A", "\uac00"})
    if (const Font& font = fontOf(letter); !isThere(font, root))
      return {"letters", State::note,
              std::string("boxes stand in the place of ") + font.letters + " ones",
              std::string("Install the package ") + font.package};
  return {"letters", State::well, "Latin, Greek, Cyrillic and Korean ones can be drawn"};
}

Finding judgeDate(const std::string& now_utc, const std::string& built_utc) {
  if (now_utc < built_utc)
    return {
        "date", State::ill,
        "the computer believes it is " + now_utc.substr(0, 10) + ", before this program was made",
        "Set the computer's date; sessions and calibrations are dated by it"};
  return {"date", State::well, now_utc.substr(0, 10) + " " + now_utc.substr(11, 5) + " UTC"};
}

Finding judgeDesktop(const Desktop& desktop) {
  if (!desktop.trouble.empty())
    return desktop.is_there
               ? Finding{"window", State::note, desktop.trouble, desktop.advice}
               : Finding{"window", State::absent, "no desktop: " + desktop.trouble, ""};
  std::string words;
  for (std::size_t i = 0; i < desktop.monitors.size(); ++i)
    words += (i > 0 ? "; " : "") + std::to_string(i + 1) + ": " + desktop.monitors[i];
  return {"window", State::well, "on monitor " + words};
}

Finding askDrawing(const std::function<Drawing()>& draw) {
  try {
    const Drawing by = draw();
    std::string words = "drawn";
    if (by.on_processor)
      words += " without a graphics card, on the processor: " + by.renderer + ",";
    else if (!by.renderer.empty())
      words += " on " + by.renderer;
    words += " by OpenGL (" + by.context + ")";
    for (std::size_t i = 0; i < by.cards.size(); ++i)
      words += (i == 0 ? "; to choose from (--gpu): " : ", ") + std::to_string(i + 1) + " (" +
               by.cards[i] + ")";
    return {"pictures", State::well, words};
  } catch (const std::exception& e) {
    Finding finding = troubled("pictures", State::ill, e.what());
    finding.fix += ". Sessions without pictures still run: --no-views";
    return finding;
  }
}

Finding judgeSound(const sound::SpeakerFound& found) {
  using Speaker = sound::Loudspeaker;
  constexpr const char* kSilent = ". Sessions go on in silence";
  if (found.state == Speaker::State::opening)
    return {"sound", State::note, "no sound: the sound server does not answer",
            std::string("Log out and in again, or restart the computer") + kSilent};
  if (found.state == Speaker::State::playing) return {"sound", State::well, "on " + found.words};
  return {"sound", State::absent, found.words + kSilent};
}

fs::path headsetRuntime() {
  if (const std::string given = environment("XR_RUNTIME_JSON"); !given.empty()) return given;
  const std::string home = environment("HOME"), config = environment("XDG_CONFIG_HOME");
  std::error_code none;
  for (const fs::path& folder : {fs::path(config.empty() ? home + "/.config" : config),
                                 fs::path("/etc/xdg"), fs::path("/etc"), fs::path("/usr/share")})
    if (fs::path file = folder / "openxr/1/active_runtime.json"; fs::exists(file, none))
      return file;
  return {};
}

Finding judgeHeadset(const fs::path& file) {
  if (file.empty())
    return {"headset", State::absent,
            "none is set up (no OpenXR runtime); the desktop shows everything"};
  const auto broken = [&file](const std::string& why) {
    return Finding{"headset", State::note, "cannot be used: " + why,
                   "Install the headset's OpenXR runtime again, or correct " + file.string() +
                       ". Sessions on the desktop run without it"};
  };
  const std::optional<std::string> text = readWhole(file);
  if (!text) return broken("the OpenXR runtime's file cannot be read: " + file.string());
  const nlohmann::json json = parsedOrDiscarded(*text);
  if (json.is_discarded() || !json.is_object() || !json.contains("runtime") ||
      !json["runtime"].is_object())
    return broken("the OpenXR runtime's file is damaged: " + file.string());
  const nlohmann::json path = json["runtime"].value("library_path", nlohmann::json());
  if (!path.is_string())
    return broken("the OpenXR runtime's file names no library: " + file.string());
  const fs::path library = path.get<std::string>();
  std::error_code none;
  const bool search = !library.has_parent_path();  // a bare name is found by the system's loader
  if (!search && !fs::exists(library.is_absolute() ? library : file.parent_path() / library, none))
    return broken("the OpenXR runtime is not where its file says: " + library.string());
  return {"headset", State::well,
          "its software is installed: OpenXR runtime " + library.filename().string()};
}

Finding askLocale() {
  std::string named = environment("LC_ALL");
  if (named.empty()) named = environment("LANG");
  const std::string before = std::setlocale(LC_ALL, nullptr);
  const bool known = std::setlocale(LC_ALL, "") != nullptr;
  std::setlocale(LC_ALL, before.c_str());
  if (!known)
    return {"language", State::note,
            "the settings name a language that is not installed" +
                (named.empty() ? std::string() : " (" + named + ")"),
            "Set LC_ALL to C.UTF-8, or install it: dpkg-reconfigure locales"};
  return {"language", State::well, named.empty() ? "none set" : named};
}

Finding askAssets() {
  try {
    return {"program's files", State::well, station::assetsFolder().string()};
  } catch (const std::exception& e) {
    return troubled("program's files", State::ill, e.what());
  }
}

namespace {

constexpr const char* kClocks = "clocks";
constexpr std::int64_t kCoarse_ns = 100'000;  // a tenth of a tick of the haptic loop
constexpr double kMoved_ms =
    5;  // a time server that corrects gently moves the date by less than 0.5 ms a second

}  // namespace

ClockWatch::ClockWatch() : ahead_(ahead()) {}

/// Both are read until nobody came between.
std::int64_t ClockWatch::ahead() const {
  std::int64_t closest = runtime::kSecond, difference = 0;
  for (int tries = 0; tries < 50 && closest > runtime::kMillisecond / 10; ++tries) {
    const std::int64_t before = clock_.now(), date = runtime::dateNow(),
                       between = clock_.now() - before;
    if (between >= closest) continue;
    closest = between;
    difference = date - before;
  }
  return difference;
}

ClockFacts ClockWatch::facts() const {
  ClockFacts facts;
  facts.resolution_ns = runtime::clockResolution();
  facts.seconds = 1e-9 * static_cast<double>(clock_.now());
  facts.date_moved_ms = 1e-6 * static_cast<double>(ahead() - ahead_);
  facts.synchronised = os::dateIsKept();
  return facts;
}

Finding judgeClocks(const ClockFacts& f, const PictureFacts& pictures, bool shared) {
  const auto note = [](std::string verdict, std::string fix) {
    return Finding{kClocks, State::note, std::move(verdict), std::move(fix)};
  };
  if (f.resolution_ns > kCoarse_ns)
    return note(
        text("the computer's clock is too coarse for steady forces: it steps by %.1f ms",
             1e-6 * static_cast<double>(f.resolution_ns)),
        "Use a kernel with high-resolution timers; in a virtual machine give it the host's clock");
  if (pictures.backward > 0)
    return note(
        text("the camera's times go back in %d of %d pictures", pictures.backward,
             pictures.pictures),
        "Unplug the camera and plug it in again; if that does not help, use another camera");
  if (pictures.undated > 0)
    return note(
        text("the camera dates %d of %d pictures by another clock: their time of arrival is taken",
             pictures.undated, pictures.pictures),
        "Calibrate the time between camera and device with this camera (palpa calibrate latency), "
        "or use one whose driver gives times");
  if (std::abs(f.date_moved_ms) > kMoved_ms)
    return note(text("the computer's date was set by %.0f ms while it was watched for %.1f s",
                     f.date_moved_ms, f.seconds),
                "Let one program keep the date (timedatectl set-ntp true); in a virtual machine "
                "turn the host's off");
  if (shared && !f.synchronised)
    return note(
        "no time server keeps this computer's date; stations that share records should agree on it",
        "timedatectl set-ntp true");
  return {kClocks, State::well,
          text("good: steps of %.0f ns, and the date goes with them",
               static_cast<double>(f.resolution_ns)) +
              (f.synchronised ? ", kept by a time server" : "")};
}

}  // namespace palpa::doctor
