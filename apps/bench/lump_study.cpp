#include "apps/bench/contact_study.h"

#include <algorithm>

#include "calibration/touch/contact_laws.h"
#include "haptics/loop/tick.h"

namespace palpa::bench {
namespace {

using twin::LedTip;

constexpr double kLumpDeep = 7e-3, kBeside = 8e-3, kOver = 0.012;            // m
constexpr double kPairDeep = 6e-3, kPairLight = 1.5e-3, kAbovePlain = 2e-3;  // m
constexpr double kLeastPressed = 0.1;                                        // N
constexpr std::uint64_t kLumpSeen = 11, kLumpFresh = 111;                    // seeds

/// As a person records it (`palpa calibrate inclusion`): above the lump, on four sides of it, and
/// stroking over it.
calibration::LumpContact identify(const twin::Phantom& lumped, const KnownPhantom& known,
                                  Noise noise) {
  const twin::PhantomTwin twin(lumped.table, {});
  std::vector<calibration::LumpSample> samples;
  const auto record = [&](const LedTip& tip, std::uint64_t seed) {
    for (const PhantomTick& tick : recordTouch(twin, tip, noise, seed))
      samples.push_back({tick.tip, Vec3::UnitZ(), tick.f_r, -tick.tip.z(),
                         -tick.dp.z() / kPhantomTick, tick.truth.lump});
  };
  record(twin::pressing(Vec3::Zero(), kLumpDeep, kLumpSeen), kLumpSeen);
  record(twin::tapping(Vec3::Zero(), kLumpDeep, kLumpSeen + 1), kLumpSeen + 1);
  record(twin::stroking(Vec3::Zero(), kLumpDeep, kOver, Vec3(0, 1, 0), kLumpSeen + 20),
         kLumpSeen + 20);
  std::uint64_t seed = kLumpSeen + 2;
  for (const Vec3& side :
       {Vec3(kBeside, 0, 0), Vec3(0, kBeside, 0), Vec3(-kBeside, 0, 0), Vec3(0, -kBeside, 0)}) {
    record(twin::pressing(side, kLumpDeep, seed), seed);
    ++seed;
  }
  return calibration::identifyLump(samples, known.contact, known.friction.law,
                                   lumped.block.lump->centre, lumped.table.tool_radius,
                                   kPhantomTick);
}

std::vector<LedTip> oneTool() {
  return {twin::pressing(Vec3(0.003, 0.002, 0), kLumpDeep, kLumpFresh),
          twin::pressing(Vec3(-0.005, 0.001, 0), kLumpDeep, kLumpFresh + 1),
          twin::tapping(Vec3(0.001, -0.002, 0), kLumpDeep, kLumpFresh + 2),
          twin::stroking(Vec3::Zero(), kLumpDeep, kOver, Vec3(0.8, 0.6, 0), kLumpFresh + 3)};
}

/// Two fingers: side by side, rolling the lump in turn, and over it and back; the shift is of the
/// middle between them.
std::vector<std::pair<const char*, LedPair>> twoTools(double apart) {
  LedPair together(0.009, apart), in_turn(0.007, apart), stroke(-0.01, apart);
  for (const double depth : {0.5 * kPairDeep, 0.8 * kPairDeep, kPairDeep})
    together.go(0.009, {depth, depth}, 0.5, 0.3).go(0.009, {-kAbovePlain, -kAbovePlain}, 0.4);
  in_turn.go(0.007, {kPairLight, kPairLight}, 0.3);
  for (int i = 0; i < 3; ++i)
    in_turn.go(0.007, {kPairDeep, kPairLight}, 0.35, 0.1)
        .go(0.007, {kPairLight, kPairDeep}, 0.35, 0.1);
  in_turn.go(0.007, {-kAbovePlain, -kAbovePlain}, 0.3);
  for (const double depth : {0.6 * kPairDeep, 0.9 * kPairDeep})
    stroke.go(-0.01, {depth, depth}, 0.4)
        .go(0.01, {depth, depth}, 0.9)
        .go(-0.01, {depth, depth}, 0.8);
  stroke.go(-0.01, {-kAbovePlain, -kAbovePlain}, 0.4);
  return {{"side by side", together}, {"rolled", in_turn}, {"stroked", stroke}};
}

/// The led tip is the lowest point of an upright tool; from below the highest.
haptics::ToolTouch toolOf(const PhantomTick& tick, const haptics::TouchAugmentation& law,
                          bool from_below = false) {
  const double up = from_below ? -law.tip_radius : law.tip_radius;
  return {true, tick.tip + up * Vec3::UnitZ(), tick.f_r};
}

/// What the tools would feel on a phantom.
TouchJudge judgeOf(const twin::Phantom& phantom, int tools) {
  if (tools == 1)
    return [one = twin::PhantomTwin(phantom.table, {})](const std::array<Vec3, 2>& tips) mutable {
      return std::array<twin::PhantomTouch, 2>{one.step(tips[0], kPhantomTick), {}};
    };
  return [both = twin::PhantomPairTwin(phantom.table, phantom.both, {})](
             const std::array<Vec3, 2>& tips) mutable { return both.step(tips, kPhantomTick); };
}

}  // namespace

std::vector<PlainTouches> touchPlain(const twin::Phantom& plain, int tools, Noise noise) {
  std::vector<PlainTouches> all;
  std::uint64_t seed = kLumpFresh;
  if (tools == 1) {
    for (const LedTip& tip : oneTool()) {
      PlainTouches& touches = all.emplace_back(PlainTouches{1, "any", {}});
      for (const PhantomTick& tick :
           recordTouch(twin::PhantomTwin(plain.table, {}), tip, noise, seed++))
        touches.ticks.push_back({tick, {}});
    }
  } else {
    for (const auto& [motion, pair] : twoTools(plain.both.apart))
      all.push_back(
          {2, motion,
           recordTouches(twin::PhantomPairTwin(plain.table, plain.both, {}), pair, noise, seed++)});
  }
  return all;
}

haptics::TouchAugmentation lumpOver(const twin::Phantom& lumped, const KnownPhantom& known,
                                    Noise noise) {
  const calibration::LumpContact found = identify(lumped, known, noise);
  haptics::TouchAugmentation law;
  law.surface.contact = feelingOf(known, kLeastPressed);
  law.kinds[0] = {found.l0, found.H_T, found.G};
  law.tip_radius = lumped.table.tool_radius;
  return law;
}

LumpFigures lumpFigures(const std::vector<PlainTouches>& plain, const Vec3& p_T0,
                        const haptics::TouchAugmentation& law,
                        const std::function<TouchJudge(const PlainTouches&)>& judges) {
  LumpFigures figures;
  RelativeRms error, unrendered;
  const haptics::PlacedLumps lumps{{{pack(p_T0), 1}}};
  for (const PlainTouches& touches : plain) {
    const TouchJudge judge = judges(touches);
    haptics::TouchAugmentationState state;
    for (const std::array<PhantomTick, 2>& ticks : touches.ticks) {
      const std::array<haptics::ToolTouch, 2> tools{
          {toolOf(ticks[0], law),
           touches.tools == 2 ? toolOf(ticks[1], law, touches.opposed) : haptics::ToolTouch{}}};
      const haptics::AugmentedTouch now =
          haptics::augmentTouch(law, lumps, tools, kPhantomTick, &state);
      figures.iterations = std::max(figures.iterations, now.iterations);
      const std::array<twin::PhantomTouch, 2> truth = judge({ticks[0].true_tip, ticks[1].true_tip});
      for (std::size_t t = 0; t < 2; ++t) {
        if (!truth[t].contact) continue;
        error.add(ticks[t].truth.f + now.f_d[t] - truth[t].f, truth[t].f);
        unrendered.add(ticks[t].truth.f - truth[t].f, truth[t].f);
        figures.position_mm =
            std::max(figures.position_mm, 1e3 * (unpack(now.d[0]) - truth[t].lump).norm());
      }
    }
  }
  figures.error = error.value();
  figures.unrendered = unrendered.value();
  return figures;
}

LumpFigures lumpFigures(const std::vector<PlainTouches>& plain, const twin::Phantom& lumped,
                        const haptics::TouchAugmentation& law) {
  return lumpFigures(plain, lumped.block.lump->centre, law,
                     [&](const PlainTouches& touches) { return judgeOf(lumped, touches.tools); });
}

namespace {

/// The longest time in which both tools touched, as the loop reads it.
std::vector<std::array<haptics::SensedForce, 2>> touchingWhile(const PlainTouches& touches,
                                                               double tip_radius) {
  std::vector<std::array<haptics::SensedForce, 2>> longest, now;
  for (const std::array<PhantomTick, 2>& ticks : touches.ticks) {
    const auto sensed = [&](const PhantomTick& tick) {
      return haptics::SensedForce{pack(tick.f_r),
                                  pack(Vec3(tick.tip + tip_radius * Vec3::UnitZ())),
                                  haptics::SensorState::valid,
                                  {}};
    };
    if (!ticks[0].truth.contact || !ticks[1].truth.contact)
      now.clear();
    else
      now.push_back({sensed(ticks[0]), sensed(ticks[1])});
    if (now.size() > longest.size()) longest = now;
  }
  return longest;
}

haptics::PairConfig everythingOn(haptics::TouchAugmentation law) {
  law.surface.contact.target.factor = 1.3;
  law.surface.wanted = law.surface.contact.friction;
  law.surface.wanted.mu *= 0.5;
  law.other_friction = 1;
  haptics::PairConfig config;
  for (haptics::TickConfig& tool : config.tools) {
    tool.contact_mode = haptics::ContactMode::sensed_object;
    tool.object_at_port = 1;
    tool.touch = law;
  }
  return config;
}

}  // namespace

PairTiming pairTiming(const std::vector<PlainTouches>& plain,
                      const haptics::TouchAugmentation& law) {
  const std::vector<std::array<haptics::SensedForce, 2>> felt =
      touchingWhile(plain.back(), law.tip_radius);
  const haptics::PairConfig config = everythingOn(law);
  haptics::TickCommands commands;
  commands.armed = 1;
  commands.lumps = {{{{0, 0, -law.kinds[0].l0}, 1}, {{-kOver, 0, -law.kinds[0].l0}, 1}}};
  haptics::PairState state;
  PairTiming timing;
  std::uint64_t pushed = 0, asked = 0;
  timing.time = timeQueries(static_cast<int>(felt.size()), [&](int i) {
    if (i == 0) state = {};  // back to where it began: no leap
    const std::array<haptics::SensedForce, 2>& sensed = felt[static_cast<std::size_t>(i)];
    std::array<haptics::DeviceReading, 2> readings;
    for (std::size_t t = 0; t < 2; ++t) {
      readings[t].t_ns = 1'000'000 * (i + 1);
      readings[t].sequence = static_cast<std::uint64_t>(i + 1);
      readings[t].p_DE = sensed[t].p_DK;
      readings[t].homed = 1;
    }
    const std::array<haptics::FlightRecord, 2> records =
        haptics::tickPair(config, state, readings, commands, readings[0].t_ns, sensed);
    asked += 2;
    for (const haptics::FlightRecord& record : records) pushed += record.f_command_D != Packed3{};
  });
  timing.pushed = static_cast<double>(pushed) / static_cast<double>(asked);
  return timing;
}

}  // namespace palpa::bench
