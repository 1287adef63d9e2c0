#include "apps/runtime/event_kind.h"

#include "anatomy/base/enum_names.h"

namespace palpa::runtime {
namespace {

const EnumNames<EventKind> kEventKinds{
    "ready",   "start", "pause", "resume", "safety",   "emergency_stop", "rearm",   "device",
    "camera",  "note",  "case",  "phase",  "puncture", "withdrawn",      "wall",    "vein",
    "touched", "mark",  "grade", "let_go", "thing",    "answer",         "computer", "picture"};

}  // namespace

const std::string& nameOf(EventKind kind) { return kEventKinds.of(kind); }

}  // namespace palpa::runtime
