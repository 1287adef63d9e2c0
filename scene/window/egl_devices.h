#pragma once

#include <string>
#include <vector>

namespace palpa::scene {

/// A graphics card, or a program that draws on the processor, as EGL lists them.
struct Gpu {
  std::string name;  ///< "NVIDIA RTX 4000/PCIe", "/dev/dri/card0", "Mesa's, on the processor"
  bool on_processor = false;
  void* device = nullptr;  ///< EGLDeviceEXT
};

/// The cards in EGL's order, then what draws on the processor. Empty without EGL, or where it lists
/// none: then Mesa's surfaceless platform may draw all the same.
std::vector<Gpu> gpus();

/// By what is drawn.
struct GpuChoice {
  bool automatic = true;  ///< the first card that can; else the processor
  int card = 0;           ///< otherwise this one of the cards among gpus(), from 1; 0: none
};

/// "auto", "none" or a number. Throws UsageError, which lists the cards, for others.
GpuChoice gpuChoiceOf(const std::string& word, const std::vector<Gpu>& all);

/// What EGL opens in turn until one gives a context.
struct EglCandidate {
  void* display = nullptr;  ///< EGLDisplay
  const char* name = "";    ///< "surfaceless EGL", "EGL device"
};
std::vector<EglCandidate> candidatesFor(const GpuChoice& choice, const std::vector<Gpu>& all);

}  // namespace palpa::scene
