#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "haptics/flight_record.h"
#include "program.h"

namespace palpa::haptics {
class FakeNetFt;
}

namespace palpa::cli_test {

enum class Hangs { for_a_while, for_ever };

/// What hangs, and what is around it.
struct HungPart {
  std::string calls;  ///< that wait: a kind of tests/computer_faults/hung_calls.h; a test's name
  std::string words;  ///< what a person calls it
  Hangs how_long = Hangs::for_a_while;
  /// It ends by becoming `palpa finish`, where the part hangs for ever
  bool ends_anew = true;
};

/// A whole session in real time: when there is force, a part of it hangs; the emergency stop is
/// pressed by the console's socket; later the part is let go, or not; SIGTERM ends the session when
/// the evidence tells of the silence, and of its end. Every step is waited for, with patience; what
/// does not come is told.
class HungSession {
 public:
  explicit HungSession(HungPart part);
  ~HungSession();

  void run();

  const HungPart part;
  const Folder folder;
  std::string trouble;  ///< the step that did not come; empty: all did
  int exit_code = -1;
  std::int64_t felt_ns = -1;  ///< session time of a tick with force, before the hang
  /// By a clock of the test's: the stop was confirmed; then the session was asked to end.
  std::int64_t confirmed_ns = 0, asked_ns = 0;
  std::string err;             ///< what it said
  bool device_pushed = false,  ///< the Falcon's motors, before the stop
      device_let_go = false;   ///< and at the end: not any more
  std::vector<haptics::FlightRecord> ticks() const;

 private:
  bool begins();
  bool hangs();
  bool isStopped();
  bool isSilentForAWhile();
  bool ends();
  bool tells(const std::string& what) const;
  bool isTold(const std::string& what);
  bool feelsForce();
  bool pushesTheGrip();
  bool waitFor(const char* step, bool came);
  std::vector<std::string> arguments();
  Environment environment() const;
  std::string station(const std::string& shipped) const;
  void commandStart();

  const bool device_;  ///< a person's Falcon, not a simulated operator
  std::unique_ptr<haptics::FakeNetFt> sensor_;
  std::unique_ptr<Running> program_;
};

}  // namespace palpa::cli_test
