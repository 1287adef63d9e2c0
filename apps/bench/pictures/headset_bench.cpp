#include <nlohmann/json.hpp>

#include "apps/bench/bench.h"
#include "apps/bench/bench_patients.h"
#include "apps/bench/pictures/session_frames.h"
#include "apps/bench/timing.h"
#include "apps/os/system_time.h"
#include "scene/view/scene_view.h"

namespace palpa::bench {
namespace {

constexpr int kEyeWidth = 1832, kEyeHeight = 1920;  // px, a common headset's
constexpr double kRate_Hz = 72;
constexpr int kWarm = 20;

}  // namespace

void benchHeadset(const HeadsetBenchOptions& options) {
  leaveOutDrawing();
  const anatomy::Patient patient = referenceBust();
  const auto context = scene::makeGlContext(scene::Display::offscreen, 64, 64, "Palpa, headset");
  scene::ViewLayout layout{2 * kEyeWidth, kEyeHeight, scene::FixedViews::none, false};
  layout.stereo = scene::Stereo::headset;
  scene::SceneView view(*context, patient, layout);
  SessionFrames frames(patient);
  const auto show = [&](int i) {
    view.show(frames.forEyes(i, i / kRate_Hz, kEyeWidth, kEyeHeight));
  };
  for (int i = 0; i < kWarm; ++i) show(i);
  const std::int64_t before_ns = os::processorTime_ns();
  for (int i = 0; i < options.frames; ++i) show(kWarm + i);
  const auto spent_ns = static_cast<double>(os::processorTime_ns() - before_ns);
  print("headset_cpu_ms", 1e-6 * spent_ns / options.frames, "ms",
        {{"frames", options.frames},
         {"eye", std::to_string(kEyeWidth) + "x" + std::to_string(kEyeHeight)},
         {"rate_Hz", kRate_Hz},
         {"triangles", trianglesOf(patient)},
         {"drawn_by", context->renderer()}});
}

}  // namespace palpa::bench
