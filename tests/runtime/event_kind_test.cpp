#include "apps/runtime/event_kind.h"

#include <gtest/gtest.h>

#include "apps/runtime/flight_sink.h"

namespace palpa::runtime {
namespace {

constexpr int kKinds = static_cast<int>(EventKind::picture) + 1;

TEST(EventKind, AnEventIsOfTheKindThatItIsRecordedAs) {
  for (int recorded = 0; recorded < kKinds; ++recorded) {
    Event event;
    event.kind = nameOf(static_cast<EventKind>(recorded));
    for (int kind = 0; kind < kKinds; ++kind)
      EXPECT_EQ(event.is(static_cast<EventKind>(kind)), kind == recorded) << event.kind;
  }
}

TEST(EventKind, NamesAreThoseOfRecords) {
  EXPECT_EQ(nameOf(EventKind::trial_case), "case");
  EXPECT_EQ(nameOf(EventKind::emergency_stop), "emergency_stop");
  EXPECT_EQ(nameOf(EventKind::let_go), "let_go");
  EXPECT_EQ(nameOf(EventKind::answer), "answer");
  EXPECT_EQ(nameOf(EventKind::computer), "computer");
  EXPECT_EQ(nameOf(EventKind::picture), "picture");
}

TEST(EventKind, HowATrialEndedIsNone) {
  Event event;
  event.kind = "aborted";
  for (int kind = 0; kind < kKinds; ++kind)
    EXPECT_FALSE(event.is(static_cast<EventKind>(kind))) << kind;
}

}  // namespace
}  // namespace palpa::runtime
