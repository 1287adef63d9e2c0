#include "scene/window/egl_devices.h"

#include <algorithm>
#include <charconv>
#include <cstring>

#include <EGL/egl.h>
#include <EGL/eglext.h>

#include "anatomy/base/error.h"

namespace palpa::scene {
namespace {

constexpr EGLint kRenderer = 0x335F;  // EGL_RENDERER_EXT, of EGL_EXT_device_query_name
constexpr EGLint kMostDevices = 16;

bool offers(const char* extensions, const char* wanted) {
  return extensions != nullptr && std::strstr(extensions, wanted) != nullptr;
}

template <class Function>
Function entry(const char* name) {
  return reinterpret_cast<Function>(eglGetProcAddress(name));
}

EGLDisplay platformDisplay(EGLenum platform, void* native) {
  static const auto get = entry<PFNEGLGETPLATFORMDISPLAYEXTPROC>("eglGetPlatformDisplayEXT");
  return get ? get(platform, native, nullptr) : EGL_NO_DISPLAY;
}

using Describe = PFNEGLQUERYDEVICESTRINGEXTPROC;

Gpu gpuOf(EGLDeviceEXT device, Describe describe) {
  const char* const can = describe(device, EGL_EXTENSIONS);
  const auto said = [&](const char* extension, EGLint what) {
    const char* const text = offers(can, extension) ? describe(device, what) : nullptr;
    return std::string(text ? text : "");
  };
  Gpu gpu;
  gpu.device = device;
  gpu.on_processor = offers(can, "EGL_MESA_device_software");
  gpu.name = said("EGL_EXT_device_query_name", kRenderer);
  if (gpu.name.empty() && gpu.on_processor) gpu.name = "Mesa's, on the processor";
  if (gpu.name.empty()) gpu.name = said("EGL_EXT_device_drm", EGL_DRM_DEVICE_FILE_EXT);
  if (gpu.name.empty()) gpu.name = "without a name";
  return gpu;
}

std::string listed(const std::vector<Gpu>& all) {
  std::string words;
  int number = 0;
  for (const Gpu& gpu : all) {
    if (gpu.on_processor) continue;
    words += words.empty() ? "" : ", ";
    words += std::to_string(++number) + " (" + gpu.name + ")";
  }
  return words;
}

}  // namespace

std::vector<Gpu> gpus() {
  const auto list = entry<PFNEGLQUERYDEVICESEXTPROC>("eglQueryDevicesEXT");
  const auto describe = entry<Describe>("eglQueryDeviceStringEXT");
  EGLDeviceEXT found[kMostDevices];
  EGLint count = 0;
  if (!list || !describe || !list(kMostDevices, found, &count)) return {};
  std::vector<Gpu> all;
  for (EGLint i = 0; i < count; ++i) all.push_back(gpuOf(found[i], describe));
  std::stable_partition(all.begin(), all.end(), [](const Gpu& gpu) { return !gpu.on_processor; });
  return all;
}

GpuChoice gpuChoiceOf(const std::string& word, const std::vector<Gpu>& all) {
  if (word == "auto") return {};
  if (word == "none") return {false, 0};
  int number = 0;
  const auto [end, problem] = std::from_chars(word.data(), word.data() + word.size(), number);
  const auto cards =
      std::count_if(all.begin(), all.end(), [](const Gpu& gpu) { return !gpu.on_processor; });
  if (problem == std::errc() && end == word.data() + word.size() && number >= 1 && number <= cards)
    return {false, number};
  throw UsageError("is no graphics card of this computer", "--gpu " + word,
                   cards == 0 ? "There is none here: leave it out, or give none"
                              : "Give auto, none or one of these: " + listed(all));
}

std::vector<EglCandidate> candidatesFor(const GpuChoice& choice, const std::vector<Gpu>& all) {
  const char* const client = eglQueryString(EGL_NO_DISPLAY, EGL_EXTENSIONS);
  std::vector<EglCandidate> candidates;
  const auto addDevices = [&](bool on_processor) {
    int number = 0;
    for (const Gpu& gpu : all) {
      if (gpu.on_processor != on_processor) continue;
      ++number;
      if (!choice.automatic && !on_processor && number != choice.card) continue;
      candidates.push_back({platformDisplay(EGL_PLATFORM_DEVICE_EXT, gpu.device), "EGL device"});
    }
  };
  const bool by_device = offers(client, "EGL_EXT_platform_device");
  const bool surfaceless = offers(client, "EGL_MESA_platform_surfaceless");
  if (by_device) addDevices(false);
  if (!choice.automatic && choice.card > 0) return candidates;  // this card, or a clear word
  const auto addSurfaceless = [&] {
    if (surfaceless)
      candidates.push_back(
          {platformDisplay(EGL_PLATFORM_SURFACELESS_MESA, EGL_DEFAULT_DISPLAY), "surfaceless EGL"});
  };
  // Mesa's surfaceless platform takes a card where it has one.
  if (choice.automatic) addSurfaceless();
  if (by_device) addDevices(true);
  if (!choice.automatic) addSurfaceless();
  return candidates;
}

}  // namespace palpa::scene
