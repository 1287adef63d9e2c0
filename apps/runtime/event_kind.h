#pragma once

#include <cstdint>
#include <string>

#include "anatomy/base/enum_names.h"

namespace palpa::runtime {

/// What an event of a session tells; the value that goes with it.
enum class EventKind : std::uint8_t {
  ready,  ///< device, board and tool: a trial may start
  start,  ///< of a trial
  pause,
  resume,
  safety,  ///< force was taken away, or is back
  emergency_stop,
  rearm,
  device,      ///< what its driver has to say
  camera,      ///< lost (1) or back (0)
  note,        ///< of somebody who looks on; session time that it is about, s, or 0
  trial_case,  ///< "case": what the trial is about, as its task writes it down
  phase,       ///< of the procedure
  puncture,    ///< of the skin
  withdrawn,   ///< the needle, out of the skin
  wall,        ///< an organ's was punctured
  vein,        ///< the tip is in it
  touched,     ///< an organ, by the needle
  mark,        ///< the trainee marks a lump
  grade,       ///< and grades it; number of the mark
  let_go,      ///< the handle of a search
  thing,       ///< that is held now
  answer,      ///< which thing has more, 1 or 2; the number of the next in an order
  computer,    ///< a part of it does not answer (1), or does again (0); it cannot keep up (1); what
               ///< a trial suffered from that, how often
  picture      ///< is kept of this moment: its file and caption; trial time, s
};

/// "ready", ..., "case", ...: in records, logs and on the wire.
inline const std::string& nameOf(EventKind kind) {
  static const EnumNames<EventKind> kEventKinds{
      "ready",   "start", "pause", "resume", "safety",   "emergency_stop", "rearm",    "device",
      "camera",  "note",  "case",  "phase",  "puncture", "withdrawn",      "wall",     "vein",
      "touched", "mark",  "grade", "let_go", "thing",    "answer",         "computer", "picture"};
  return kEventKinds.of(kind);
}

}  // namespace palpa::runtime
