#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace palpa::test_xr {

/// What the runtime is to be like, from the environment variable PALPA_TEST_XR: words "name=value"
/// with semicolons between them.
struct Plan {
  std::vector<std::pair<int, int>> eyes{{320, 256}, {320, 256}};  ///< eyes=320x256,300x200
  std::vector<std::int64_t> formats{0x8C43};  ///< formats=8C43,881A: OpenGL's, hexadecimal
  int images = 3;                             ///< in a swapchain
  std::string blend = "opaque";
  double apart = 0.064;  ///< m between the eyes
  double rate_Hz = 90;
  bool position = true;  ///< 0: only how the head is turned is known
  std::string controller = "/interaction_profiles/khr/simple_controller";
  double turned_deg = 0;  ///< turned=90: how the head is turned, to the left
  double drift_mm = 0;    ///< drift=5: how far the head moves to its right from frame to frame
  int stands = 400;       ///< the frame from which on the hand stands still
  std::string fault;      ///< fault=session_lost@120: what happens, and in which frame
  int fault_frame = 0;
  std::string hang;      ///< hang=FILE: functions that do not return while the file names them
  std::string service;   ///< service=FILE: every call asks a process, whose number stands there
  std::string report;    ///< file for what the program did
  std::string pictures;  ///< folder for what it showed last: eye0.pam, eye1.pam
  std::string layers;    ///< file that grows by a byte with each layer that is shown

  bool failsFromTheStart(const std::string& name) const {
    return fault == name && fault_frame == 0;
  }
};
Plan planFromEnvironment();

}  // namespace palpa::test_xr
