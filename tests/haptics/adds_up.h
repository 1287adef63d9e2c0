#pragma once

#include <gtest/gtest.h>

#include "haptics/loop/tick.h"

namespace palpa::haptics {

/// What a tick's force is made of adds up to what was recorded of it, where nothing is limited.
inline void expectAddsUp(const FlightRecord& record, const TickForces& f) {
  const Vec3 contact = f.body + f.stiffness + f.friction + f.weight + f.taken + f.texture + f.lumps;
  Vec3 added = f.pulse;
  for (const Vec3& cue : f.cues) added += cue;
  constexpr double kClose = 1e-12;  // N: sums in another order
  EXPECT_LT((contact - unpack(record.f_contact_D)).norm(), kClose) << record.tick;
  EXPECT_LT((added - unpack(record.f_augmentation_D)).norm(), kClose) << record.tick;
  const Vec3 wanted = f.rendered * (contact + added) + f.held + f.damping;
  EXPECT_LT((wanted - unpack(record.f_wanted_D)).norm(), kClose) << record.tick;
}

}  // namespace palpa::haptics
