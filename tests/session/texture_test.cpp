#include <gtest/gtest.h>

#include "anatomy/base/error.h"
#include "apps/session/comparison_session.h"
#include "apps/session/palpation_session.h"
#include "apps/session/pulse_session.h"
#include "apps/station/assets.h"
#include "apps/station/material_files.h"
#include "quick_sessions.h"

/// A texture that the library of a task names, within what the station's limiter lets through.
namespace palpa::session {
namespace {

template <class World>
void expectBounded(World* world) {
  SessionOptions options = quick(OperatorKind::expert);
  world->task.library.texture =
      station::readTexture(station::assetFile("materials/textures/wood.json"));
  const haptics::TextureLaw unbounded = world->task.library.texture;
  options.rate_Hz = 1000;
  const double slew = world->station.safety.max_slew_N_per_s,
               largest = world->tickConfig(options).touch.texture.largest;
  EXPECT_EQ(largest, station::bounded(unbounded, slew, 1000).largest);
  EXPECT_NE(largest, unbounded.largest) << "the file knows no station";
  options.rate_Hz = 2000;
  EXPECT_THROW(world->tickConfig(options), UsageError) << "made at 1 kHz";
}

TEST(Texture, IsBoundedWhateverIsDoneOnTheSilicone) {
  const SessionOptions options = quick(OperatorKind::expert);
  PalpationWorld palpation(options);
  expectBounded(&palpation);
  ComparisonWorld friction(options, training::Engine::friction);
  expectBounded(&friction);
  PulseWorld pulse(options);
  expectBounded(&pulse);
}

}  // namespace
}  // namespace palpa::session
