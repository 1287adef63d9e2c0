#pragma once

#include <cstdint>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include <openxr/openxr.h>

#include "anatomy/geometry/pose.h"

namespace palpa::ar {

/// A call that the runtime refused.
class XrFailure : public std::runtime_error {
 public:
  XrFailure(XrResult result, const std::string& call);
  XrResult result() const { return result_; }

 private:
  XrResult result_;
};

/// Throws XrFailure for errors; successes of all kinds come back.
XrResult xrCheck(XrResult result, const char* call);

/// What happened and what to do, for people.
struct XrWords {
  std::string what, advice;
};
XrWords inWords(const XrFailure& failure);

/// A list as OpenXR hands it over: asked for its length first.
template <class T, class Enumerate>
std::vector<T> xrListed(Enumerate enumerate, const char* call, const T& blank = {}) {
  std::uint32_t count = 0;
  xrCheck(enumerate(0, &count, nullptr), call);
  std::vector<T> all(count, blank);
  xrCheck(enumerate(count, &count, all.data()), call);
  all.resize(count);
  return all;
}

/// A handle that is given back.
template <class T, XrResult (*Destroy)(T)>
class XrOwned {
 public:
  XrOwned() = default;
  explicit XrOwned(T handle) : handle_(handle) {}
  XrOwned(XrOwned&& other) noexcept : handle_(std::exchange(other.handle_, T{})) {}
  XrOwned& operator=(XrOwned&& other) noexcept {
    std::swap(handle_, other.handle_);
    return *this;
  }
  ~XrOwned() {
    if (handle_) Destroy(handle_);
  }
  T get() const { return handle_; }

 private:
  T handle_{};
};

using XrOwnedInstance = XrOwned<XrInstance, xrDestroyInstance>;
using XrOwnedSession = XrOwned<XrSession, xrDestroySession>;
using XrOwnedSpace = XrOwned<XrSpace, xrDestroySpace>;
using XrOwnedSwapchain = XrOwned<XrSwapchain, xrDestroySwapchain>;
using XrOwnedActionSet = XrOwned<XrActionSet, xrDestroyActionSet>;

}  // namespace palpa::ar

/// The one place where OpenXR's axes (+x right, +y up, +z toward the person; everything looks along
/// -z) meet ours.
namespace palpa::ar {

/// Pose in L (+z up) of something that looks along its own +z (eye, head, hand).
Pose poseFromXr(const XrPosef& pose_in_space);
XrVector3f positionToXr(const Vec3& p_L);
XrPosef identityXr();

}  // namespace palpa::ar
