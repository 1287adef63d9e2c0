#pragma once

#include <GL/gl.h>
// X11's headers define macros with everyday names: this runtime has no use for them.
#include <EGL/egl.h>
#include <GL/glx.h>
#define XR_USE_GRAPHICS_API_OPENGL
#define XR_USE_PLATFORM_XLIB
#define XR_USE_PLATFORM_EGL
#include <openxr/openxr.h>
#include <openxr/openxr_platform.h>

#include <deque>
#include <map>
#include <mutex>
#include <string>
#include <vector>

#include "tests/openxr_runtime/gate.h"
#include "tests/openxr_runtime/ledger.h"
#include "tests/openxr_runtime/plan.h"

namespace palpa::test_xr {

struct Swapchain {
  int width = 0, height = 0;
  std::vector<GLuint> textures;
  std::uint32_t next = 0, acquired = 0, released = 0;  ///< released: the last one
  bool held = false, waited = false, ever = false;
};

/// One program, one instance, one session, one head that looks straight ahead and one right hand
/// that draws a circle.
struct World {
  Plan plan;
  Ledger ledger;
  XrInstance instance = XR_NULL_HANDLE;
  XrSession session = XR_NULL_HANDLE;
  bool running = false, lost = false, frame_waited = false, frame_begun = false, exit_asked = false;
  int frame = 0;  ///< frames that were waited for
  std::deque<XrEventDataBuffer> events;
  std::map<XrSwapchain, Swapchain> swapchains;
  std::map<std::string, XrPath> paths;
  std::map<XrPath, std::string> names;
  std::map<XrAction, std::pair<std::string, XrActionType>> actions;
  std::map<XrSpace, int> spaces;  ///< 0: local, 1: view, 2: left hand, 3: right hand
  std::map<std::string, std::vector<std::pair<XrAction, std::string>>> bindings;  ///< by profile
  XrTime now = 1'000'000'000;

  void tell(XrSessionState state);
  bool faultNow(const std::string& name) const {
    return plan.fault == name && frame >= plan.fault_frame;
  }
  const std::string& nameOf(XrPath path) { return names[path]; }
};
World& world();
/// Of what a thread that waits for frames and the one that polls events both touch.
std::mutex& shared();

/// Where the right hand is in a frame, in the local space; it draws the trigger slowly and turns
/// about its axis of pointing.
XrPosef handAt(int frame);
float triggerAt(int frame);
bool boundNow(XrAction action);

/// Every function that this runtime has.
const std::map<std::string, PFN_xrVoidFunction>& functions();
void addInstanceFunctions(std::map<std::string, PFN_xrVoidFunction>* all);
void addSessionFunctions(std::map<std::string, PFN_xrVoidFunction>* all);
void addInputFunctions(std::map<std::string, PFN_xrVoidFunction>* all);

#define PALPA_XR(function)                   \
  Gated<&(function)>::name = "xr" #function; \
  all->emplace("xr" #function, reinterpret_cast<PFN_xrVoidFunction>(&Gated<&(function)>::call))

/// Lists as OpenXR hands them over: asked for their length first.
template <class T>
XrResult give(const std::vector<T>& all, std::uint32_t capacity, std::uint32_t* count, T* out) {
  *count = static_cast<std::uint32_t>(all.size());
  if (capacity == 0) return XR_SUCCESS;
  if (capacity < all.size()) return XR_ERROR_SIZE_INSUFFICIENT;
  for (std::size_t i = 0; i < all.size(); ++i) out[i] = all[i];
  return XR_SUCCESS;
}

}  // namespace palpa::test_xr
