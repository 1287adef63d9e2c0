#pragma once

#include <filesystem>
#include <string>

#include "apps/console/web/guard.h"
#include "apps/runtime/clock.h"

namespace palpa::console {

/// Where the console works: what it keeps, and what it hands to the commands that it starts.
struct ConsolePlace {
  std::filesystem::path home;   ///< sessions, jobs, settings, certificates, what was refused
  std::filesystem::path pages;  ///< index.html and the rest
  std::string records;          ///< of trainees: a file or a server
  std::string sockets;          ///< folder of local sockets
  std::string version;
  std::string room_camera;  ///< films those who agree; empty: there is none
  bool reached = false;     ///< from other computers: by its address, or by another name
  bool display = false;     ///< a window can be opened: a person may hold the tool

  std::filesystem::path settings() const { return home / "settings.json"; }
  std::filesystem::path sessions() const { return home / "sessions"; }
  std::filesystem::path jobs() const { return home / "jobs"; }
};

/// "20260301-123000-1a2b3c4d": in the order of time, never twice.
std::string newId();
using runtime::utcNow;

/// A name in a session's folder that may be shown: report.html, trials.csv, view-*.png,
/// exam-*.html, certificate-*.pdf; else it is not handed out.
bool isShown(const std::string& name);

}  // namespace palpa::console
