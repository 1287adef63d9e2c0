#include "apps/bench/lump_study.h"

#include <algorithm>
#include <array>

#include "calibration/lump_contact.h"
#include "haptics/virtual_inclusion.h"

namespace palpa::bench {
namespace {

constexpr double kLumpDeep = 7e-3, kBeside = 8e-3, kOver = 0.012;   // m
constexpr double kLeastPressed = 0.1;   // N
constexpr std::uint64_t kLumpSeen = 11, kLumpFresh = 111;   // seeds

/// As a person records it: above the lump, and on four sides of it.
calibration::LumpContact identify(const twin::Phantom& lumped, const KnownPhantom& known, Noise noise) {
  const twin::PhantomTwin twin(lumped.table, {});
  std::vector<calibration::LumpSample> samples;
  const auto record = [&](const LedTip& tip, std::uint64_t seed) {
    for (const PhantomTick& tick : recordTouch(twin, tip, noise, seed))
      samples.push_back({tick.tip, Vec3::UnitZ(), tick.f_r, -tick.tip.z(), -tick.dp.z() / kPhantomTick, tick.truth.lump});
  };
  record(pressing(Vec3::Zero(), kLumpDeep, kLumpSeen), kLumpSeen);
  record(tapping(Vec3::Zero(), kLumpDeep, kLumpSeen + 1), kLumpSeen + 1);
  std::uint64_t seed = kLumpSeen + 2;
  for (const Vec3& side : {Vec3(kBeside, 0, 0), Vec3(0, kBeside, 0), Vec3(-kBeside, 0, 0), Vec3(0, -kBeside, 0)}) {
    record(pressing(side, kLumpDeep, seed), seed);
    ++seed;
  }
  return calibration::identifyLump(samples, known.contact, lumped.block.lump->centre, kPhantomTick);
}

std::vector<LedTip> freshTips() {
  return {pressing(Vec3(0.003, 0.002, 0), kLumpDeep, kLumpFresh), pressing(Vec3(-0.005, 0.001, 0), kLumpDeep, kLumpFresh + 1), tapping(Vec3(0.001, -0.002, 0), kLumpDeep, kLumpFresh + 2),
          stroking(Vec3::Zero(), kLumpDeep, kOver, Vec3(0.8, 0.6, 0), kLumpFresh + 3)};
}

}  // namespace

LumpFigures lumpFigures(const twin::Phantom& plain, const twin::Phantom& lumped, const KnownPhantom& known, Noise noise) {
  const calibration::LumpContact found = identify(lumped, known, noise);
  const haptics::VirtualInclusion lump{lumped.block.lump->centre, found.l0, found.H_T, found.G};
  const haptics::StiffnessModulation feel = feelingOf(known, kLeastPressed);
  LumpFigures figures;
  RelativeRms error, unrendered;
  std::uint64_t seed = kLumpFresh;
  for (const LedTip& tip : freshTips()) {
    const std::vector<PhantomTick> real = recordTouch(twin::PhantomTwin(plain.table, {}), tip, noise, seed++);
    twin::PhantomTwin judge(lumped.table, {});
    haptics::StiffnessModulationState contact;
    haptics::InclusionState state;
    for (const PhantomTick& tick : real) {
      const haptics::Modulated felt = haptics::modulateStiffness(feel, tick.f_r, tick.dp, kPhantomTick, &contact);
      const std::array<haptics::InclusionContact, 2> tools{{{felt.contact, tick.tip, felt.u_n, felt.x, lumped.table.tool_radius}, {}}};
      const haptics::InclusionAnswer answer = haptics::feelInclusion(lump, tools, kPhantomTick, &state);
      const Vec3 f_d = answer.f_T[0] + haptics::rubbedByLump(answer.f_T[0], tick.f_r - felt.f_n * felt.u_n, felt.f_n, felt.u_n);
      const twin::PhantomTwin::Touch truth = judge.step(tick.true_tip, kPhantomTick);
      figures.iterations = std::max(figures.iterations, answer.iterations);
      if (!truth.contact) continue;
      error.add(tick.truth.f + f_d - truth.f, truth.f);
      unrendered.add(tick.truth.f - truth.f, truth.f);
      figures.position_mm = std::max(figures.position_mm, 1e3 * (answer.d - truth.lump).norm());
    }
  }
  figures.error = error.value();
  figures.unrendered = unrendered.value();
  return figures;
}

}  // namespace palpa::bench
