#include "apps/bench/bench.h"

#include <algorithm>
#include <map>
#include <numbers>
#include <string>

#include "apps/bench/contact_study.h"
#include "apps/bench/taking_study.h"
#include "apps/bench/texture_study.h"
#include "apps/bench/timing.h"
#include "apps/station/assets.h"
#include "apps/task_pulse/pulse_file.h"

namespace palpa::bench {
namespace {

nlohmann::json paramsOf(Noise noise) {
  return {{"noise", nameOf(noise)}, {"cleared", clearedBy(noise)}, {"data", "simulated"}};
}

void benchContact(const twin::Phantom& phantom, const KnownPhantom& known, Noise noise) {
  const std::vector<TouchRun> runs = freshTouches(twin::PhantomTwin(phantom.table, {}), noise);
  print("hc_force_rel_rms", contactForceError(known, {runs[0], runs[1]}), "1", paramsOf(noise));
  print("dahl_force_rel_rms", frictionForceError(known, {runs[2]}), "1", paramsOf(noise));
  for (const TouchRun& run : runs) {
    nlohmann::json params = paramsOf(noise);
    params["motion"] = run.motion;
    print("reaction_delay_ms", 1e3 * reactionDelay(run), "ms", params);
    const StiffnessFigures null = stiffnessFigures(known, run, 1);
    print("null_modulation_n", null.largest_N, "N", params);
    print("null_modulation_share", null.largest_share, "1", params);
    for (const double factor : {0.5, 0.75, 1.5, 2.0}) {
      params["factor"] = factor;
      print("stiffness_rel_error", stiffnessFigures(known, run, factor).error, "1", params);
    }
  }
  print("friction_rel_error", frictionModulationError(known, phantom.table, {runs[2]}), "1",
        paramsOf(noise));
}

void benchSqueeze(const twin::PhantomTable& side, const calibration::SoftContact& known,
                  Noise noise) {
  for (const double mass : {0.0, 0.05}) {
    for (const double tilt_deg : {0.0, 30.0, 60.0}) {
      double worst = 0;
      for (const double factor : {0.5, 2.0}) {
        for (const bool swapped : {false, true})
          worst = std::max(
              worst,
              squeezeError(side, known, {mass, tilt_deg * std::numbers::pi / 180, factor, swapped},
                           noise));
      }
      nlohmann::json params = paramsOf(noise);
      params["mass_kg"] = mass;
      params["tilt_deg"] = tilt_deg;
      print("squeeze_rel_error", worst, "1", params);
    }
  }
}

/// A second tool that is only tracked, of both kinds of contact.
void benchEstimate(const std::vector<PlainTouches>& plain, const haptics::StiffnessModulation& law,
                   double tip_radius, double thickness, Noise noise) {
  for (const PlainTouches& touches : plain) {
    nlohmann::json params = paramsOf(noise);
    params["motion"] = touches.motion;
    print("estimated_force_rel_rms", estimateError(touches, law, tip_radius, thickness), "1",
          params);
  }
}

void benchLumps(const std::vector<twin::Phantom>& phantoms, const KnownPhantom& known, Noise noise,
                std::size_t most) {
  const std::array<std::vector<PlainTouches>, 2> plain{touchPlain(phantoms.front(), 1, noise),
                                                       touchPlain(phantoms.front(), 2, noise)};
  for (std::size_t i = 1; i < phantoms.size() && i <= most; ++i) {
    const haptics::TouchAugmentation law = lumpOver(phantoms[i], known, noise);
    if (i == 1 && noise == Noise::none) {
      const PairTiming timing = pairTiming(plain[1], law);
      nlohmann::json params = paramsOf(noise);
      params["contacts"] = params["lumps"] = 2;
      print("har_tick_hot_median", timing.time.median_us, "us", params);
      print("har_tick_hot_p99", timing.time.p99_us, "us", params);
      print("har_tick_pushed", timing.pushed, "1", params);
    }
    for (const std::size_t tools : {1, 2}) {
      nlohmann::json params = paramsOf(noise);
      params["mockup"] = phantoms[i].name;
      params["contacts"] = tools;
      const LumpFigures figures = lumpFigures(plain[tools - 1], phantoms[i], law);
      print("inclusion_force_rel_rms", figures.error, "1", params);
      print("inclusion_none_rel_rms", figures.unrendered, "1", params);
      print("inclusion_position_error_mm", figures.position_mm, "mm", params);
      print("solver_iterations_max", figures.iterations, "1", params);
    }
    nlohmann::json params = paramsOf(noise);
    params["mockup"] = phantoms[i].name;
    const TakenFigures taken = takenFigures(phantoms.front(), phantoms[i], law, noise);
    print("taken_lump_rel_rms", taken.left, "1", params);
    print("untaken_lump_rel_rms", taken.there, "1", params);
    print("taken_stiffness", taken.taken_N_per_m, "N/m", params);
    if (i == 1)
      benchEstimate(plain[1], feelingOf(known, 0.1), phantoms[i].table.tool_radius, 0, noise);
    for (const PlainTouches& touches : plain[1]) {
      params["motion"] = touches.motion;
      print("two_tools_rel_rms", lumpFigures({touches}, phantoms[i], law).error, "1", params);
    }
  }
}

/// A trembling hand whose 8 to 12 Hz are damped, with every device and each of `hands`: the worst.
void benchSteadied(const std::vector<twin::HandGrip>& hands) {
  for (const JudgedDevice& device : judgedDevices()) {
    SteadiedFigures worst{0, 0, 0, 0};
    for (const twin::HandGrip& grip : hands) {
      SteadiedCase one;
      one.truth = device.truth;
      one.grip = grip;
      const SteadiedFigures figures = steadiedFigures(one);
      worst = {std::max(worst.tremor, figures.tremor), std::max(worst.voluntary, figures.voluntary),
               std::max(worst.beside, figures.beside),
               std::max(worst.largest_N, figures.largest_N)};
    }
    nlohmann::json params = paramsOf(Noise::kalman);
    params["device"] = device.name;
    params["damping_Ns_per_m"] = SteadiedCase{}.band.damping;
    print("steadied_tremor_rel_rms", worst.tremor, "1", params);
    print("steadied_voluntary_rel_rms", worst.voluntary, "1", params);
    print("steadied_beside_rel_rms", worst.beside, "1", params);
    print("steadied_largest_force", worst.largest_N, "N", params);
  }
}

/// A slab between two tools that press from opposite sides.
void benchOpposed(const std::vector<twin::OpposedPhantom>& slabs, Noise noise) {
  const KnownSlab known = identifySlab(slabs.front().table, noise);
  const std::vector<PlainTouches> plain = pinchPlain(slabs.front().table, noise);
  benchEstimate(plain, feelingOf(known.pinched, 0.1), slabs.front().table.tool_radius,
                slabs.front().block.height, noise);
  for (std::size_t i = 1; i < slabs.size(); ++i) {
    const haptics::TouchAugmentation law = lumpInSlab(slabs[i], known, noise);
    for (const PlainTouches& touches : plain) {
      nlohmann::json params = paramsOf(noise);
      params["mockup"] = "slab, " + slabs[i].name;
      params["motion"] = touches.motion;
      const LumpFigures figures = opposedFigures({touches}, slabs[i], law);
      print("two_tools_rel_rms", figures.error, "1", params);
      print("two_tools_none_rel_rms", figures.unrendered, "1", params);
    }
  }
}

/// Every artery of the shipped task, on it and beside it, with the hand of the middle of the
/// published range. Where there was no noise they are felt through the low-pass, for a hand always
/// feels through something.
void benchPulse(const twin::PhantomTwin& plain, const KnownPhantom& known, Noise identified) {
  const Noise noise = identified == Noise::none ? Noise::low_passed : identified;
  const task_pulse::PulseSettings task =
      task_pulse::readPulse(station::assetFile("tasks/pulse.json"));
  for (std::size_t i = 0; i < task.arteries.size(); ++i) {
    const task_pulse::ArteryFigures& figures = task.arteries[i];
    PulseCase one;
    one.truth = judgedDevices().front().truth;
    one.grip = {500, 6, 0.1};
    one.noise = noise;
    one.law.surface = {feelingOf(known, 0.1), known.friction.law};
    one.pulse = task.law;
    one.artery.a_P = {0, 1, 0};
    one.artery.half_length = figures.half_length;
    one.artery.depth = figures.depth;
    one.artery.strength_N = figures.strength_N;
    one.artery.best_N = figures.best_N;
    one.artery.vessel = static_cast<std::uint32_t>(i + 1);
    one.pressed = known.contact.x0 + haptics::depthOf(known.contact.law, figures.best_N, 0);
    for (const double beside_mm : {0.0, 3.0}) {
      one.beside = 1e-3 * beside_mm;
      nlohmann::json params = paramsOf(noise);
      params["artery"] = figures.name;
      params["beside_mm"] = beside_mm;
      params["hands"] = 1;
      print("pulse_rel_rms", pulseError(plain, one), "1", params);
    }
  }
}

/// The worst hand for every device and modulation.
class WorstHands {
 public:
  explicit WorstHands(Noise noise) : noise_(noise) {}
  void add(const std::string& device, const std::string& modulation, const HandFigures& figures) {
    HandFigures& w = worst_[{device, modulation}];
    w = {std::max(w.still_mm_s, figures.still_mm_s), std::max(w.gained_mJ, figures.gained_mJ),
         std::max(w.largest_N, figures.largest_N)};
  }
  void print(std::size_t hands) const {
    for (const auto& [which, figures] : worst_) {
      nlohmann::json params = paramsOf(noise_);
      params["device"] = which.first;
      params["modulation"] = which.second;
      params["hands"] = hands;
      bench::print("hand_still_mm_s", figures.still_mm_s, "mm/s", params);
      bench::print("hand_gained_mJ", figures.gained_mJ, "mJ", params);
      bench::print("hand_largest_force", figures.largest_N, "N", params);
    }
  }

 private:
  Noise noise_;
  std::map<std::pair<std::string, std::string>, HandFigures> worst_;
};

/// With laws identified with `noise`. Where there was none they are felt through the low-pass, for
/// a hand always feels through something.
void benchHands(const std::vector<twin::Phantom>& phantoms, const KnownPhantom& known,
                const std::vector<twin::HandGrip>& hands, Noise noise) {
  const twin::PhantomTwin plain(phantoms.front().table, {});
  const Noise felt = noise == Noise::none ? Noise::low_passed : noise;
  WorstHands worst(felt);
  const twin::PhantomTwin lumped(phantoms[1].table, {});
  for (HandCase one : handCases(known, lumpOver(phantoms[1], known, noise),
                                phantoms[1].block.lump->centre, hands, felt)) {
    worst.add(one.device, one.modulation, handFigures(plain, one));
    if (one.modulation != "lump") continue;
    one.lumps[0].taken = 1;
    worst.add(one.device, "a real lump, taken away", handFigures(lumped, one));
  }
  double dropped_mm = 0;
  for (const GripCase& one : gripCases(known.contact, hands, felt)) {
    const GripFigures figures = gripFigures(phantoms.front().table, one);
    worst.add(one.device, one.modulation == "none" ? "squeezed, none" : one.modulation,
              figures.hands);
    dropped_mm = std::max(dropped_mm, figures.dropped_mm);
  }
  worst.print(hands.size());
  nlohmann::json params = paramsOf(felt);
  params["hands"] = hands.size();
  print("held_object_slid_mm", dropped_mm, "mm", params);
}

/// Each of the four surfaces as base: what is felt in place of its stiffness, and of its friction.
void benchSurfaces(const twin::Phantom& plain, Noise noise) {
  for (const twin::SoftSurface& surface :
       twin::readSoftSurfaces(station::assetFile("materials/surfaces.json"))) {
    const twin::Phantom block = surface.madeOf(plain);
    const twin::PhantomTwin phantom(block.table, surface.law);
    const KnownPhantom known = identifyPhantom(phantom, noise);
    const std::vector<TouchRun> runs = freshTouches(phantom, noise);
    double worst = 0;
    for (const TouchRun& run : runs)
      for (const double factor : {0.5, 2.0})
        worst = std::max(worst, stiffnessFigures(known, run, factor).error);
    nlohmann::json params = paramsOf(noise);
    params["surface"] = surface.name;
    print("surface_stiffness_rel_error", worst, "1", params);
    print("surface_friction_rel_error", frictionModulationError(known, block.table, {runs[2]}), "1",
          params);
  }
}

/// Half way between the forces and speeds of the models: at none of those they were fitted to.
void benchTextures(bool quick) {
  constexpr std::uint64_t kFreshSeed = 900;
  const twin::RoughBench rough =
      twin::readRoughBench(station::assetFile("phantoms/textures/surfaces.json"));
  for (const ShippedTexture& texture : shippedTextures(rough)) {
    std::uint64_t seed = kFreshSeed;
    double worst = 0, worst_hand = 0, largest = 0, limited = 0;
    for (const double speed : {0.046, 0.082, 0.195}) {
      for (const double force : {0.41, 1.38}) {
        twin::RoughStroke stroke;
        stroke.force = force;
        stroke.speed = speed;
        stroke.seed = ++seed;
        if (quick && speed != 0.082) continue;
        const TextureFigures figures = textureFigures(texture, rough.tool, stroke);
        worst = std::max(worst, std::abs(worstOf(figures.commanded_dB)));
        worst_hand = std::max(worst_hand, std::abs(worstOf(figures.hand_dB)));
        largest = std::max(largest, figures.largest_N);
        limited = std::max(limited, figures.limited);
      }
    }
    nlohmann::json params = paramsOf(Noise::none);
    params["texture"] = texture.surface.name;
    params["at"] = "commanded";
    print("texture_worst_dB", worst, "dB", params);
    print("texture_largest_n", largest, "N", params);
    print("texture_limited", limited, "1", params);
    params["at"] = "the twin's hand";
    print("texture_worst_dB", worst_hand, "dB", params);
  }
}

}  // namespace

void benchMaterial(const MaterialBenchOptions& options) {
  const std::vector<twin::Phantom> phantoms =
      twin::readSolved(station::assetFile("phantoms/mockups.json"),
                       station::assetFile("phantoms/mockups.tables.json"));
  const std::vector<twin::OpposedPhantom> slabs =
      twin::readSolvedOpposed(station::assetFile("phantoms/opposed.json"),
                              station::assetFile("phantoms/opposed.tables.json"));
  const twin::PhantomTwin plain(phantoms.front().table, {});
  print("hc_param_error", lawError(), "1", paramsOf(Noise::none));
  benchTextures(options.quick);
  benchSteadied(options.quick ? ringingHands() : judgedHands());
  for (const Noise noise : {Noise::none, Noise::low_passed, Noise::kalman}) {
    if (options.quick && noise != Noise::none) break;
    const KnownPhantom known = identifyPhantom(plain, noise);
    benchContact(phantoms.front(), known, noise);
    benchSurfaces(phantoms.front(), noise);
    benchSqueeze(phantoms.front().table, known.contact, noise);
    if (noise != Noise::low_passed) benchPulse(plain, known, noise);
    if (noise != Noise::low_passed)
      benchHands(phantoms, known, options.quick ? ringingHands() : judgedHands(), noise);
    benchLumps(phantoms, known, noise, options.quick ? 3 : phantoms.size());
    benchOpposed(slabs, noise);
  }
}

}  // namespace palpa::bench
