#include "haptics/tick_pair.h"

#include "haptics/tick_frame.h"

namespace palpa::haptics {
namespace {

/// What is added under each tool, in P.
struct Added {
  std::array<Vec3, 2> f_d{Vec3::Zero(), Vec3::Zero()};
  std::array<double, 2> x{}, f_n{};
};

Added pressed(const PairConfig& config, PairState& state, const std::array<ToolTouch, 2>& tools,
              const PlacedLumps& lumps, double dt) noexcept {
  const AugmentedTouch now = augmentTouch(config.tools[0].touch, lumps, tools, dt, &state.touch);
  return {now.f_d, {now.touch[0].x, now.touch[1].x}, {now.touch[0].f_n, now.touch[1].f_n}};
}

/// Where one of the tools is not believed it feels nothing: no contact.
Added squeezed(const PairConfig& config, PairState& state, const std::array<ToolTouch, 2>& tools,
               const TickCommands& commands) noexcept {
  SqueezeModulation law = config.squeeze;
  law.target.factor *= static_cast<double>(commands.squeeze_stiffness);
  law.weight_factor *= static_cast<double>(commands.squeeze_weight);
  const Squeezed now = modulateSqueeze(law, {tools[0].f_r, tools[1].f_r},
                                       {tools[0].p_M, tools[1].p_M}, &state.squeeze);
  return {now.f_d, {now.x, now.x}, {now.F, now.F}};
}

}  // namespace

std::array<FlightRecord, 2> tickPair(const PairConfig& config, PairState& state,
                                     const std::array<DeviceReading, 2>& readings,
                                     const TickCommands& commands, std::int64_t now_ns,
                                     const std::array<SensedForce, 2>& sensed) noexcept {
  if (commands.trial != state.trial) {
    state.trial = commands.trial;
    state.touch = {};
    state.squeeze = {};
  }
  std::array<TickFrame, 2> frames;
  std::array<ToolTouch, 2> tools;
  for (std::size_t t = 0; t < 2; ++t) {
    frames[t] = beginTick(config.tools[t], state.tools[t], readings[t], nullptr, commands, now_ns,
                          sensed[t]);
    if (frames[t].felt) tools[t] = touchIn(config.tools[t], sensed[t]);
  }
  const Added added = config.squeezing
                          ? squeezed(config, state, tools, commands)
                          : pressed(config, state, tools, commands.lumps, frames[0].input.dt);
  std::array<FlightRecord, 2> records;
  for (std::size_t t = 0; t < 2; ++t)
    records[t] =
        finishTick(config.tools[t], state.tools[t],
                   addedIn(config.tools[t], added.f_d[t], added.x[t], added.f_n[t]), frames[t]);
  records[1].tool = 1;
  return records;
}

}  // namespace palpa::haptics
