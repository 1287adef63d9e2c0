#pragma once

#include <array>
#include <chrono>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>

#include "anatomy/geometry/pose.h"

/// A display on the head. L: where the headset was when it began (or was recentred by its own
/// system), +x right, +y away from the person, **+z up**. H: the head; E: an eye, +z the way it
/// looks, +y down, as cameras are. G: a hand's controller, +z the way it points.
namespace palpa::ar {

/// What connects OpenGL to the window system.
enum class GlPlatform { glx, egl };

/// The OpenGL context that the pictures are drawn in, as GLX or EGL have it. It belongs to the
/// headset, whose runtime's calls are made with it on a thread of their own, and is lent to the
/// thread that uses the headset from a begin() that gave a frame until end().
struct GlBinding {
  GlPlatform kind = GlPlatform::egl;
  void* display = nullptr;
  void* config = nullptr;  ///< GLXFBConfig or EGLConfig
  void* context = nullptr;
  unsigned long drawable = 0;                   ///< GLX
  unsigned visual = 0;                          ///< GLX
  void (*(*address)(const char*))() = nullptr;  ///< of OpenGL's functions (EGL)
  std::shared_ptr<void> owner;  ///< never let go where the runtime hangs with the context
};

/// How long a runtime is waited for.
struct HeadsetPatience {
  std::chrono::milliseconds frame{100};    ///< by one call of begin() or end()
  std::chrono::milliseconds silent{2000};  ///< until the session goes on without the headset
  std::chrono::milliseconds opening{10000};
  std::chrono::milliseconds closing{5000};
};

/// What one eye sees: tangents of the angles to the picture's edges (left and down negative as a
/// rule), and where the eye is.
struct EyeView {
  int width = 0, height = 0;  ///< pixels that the runtime recommends
  double left = -1, right = 1, up = 1, down = -1;
  Pose X_LE = Pose::Identity();
};

struct HandInput {
  bool tracked = false;
  Pose X_LG = Pose::Identity();
  double trigger = 0;  ///< 0..1
};

struct HeadsetFrame {
  bool draw = false;               ///< false: nobody looks; there is no need to draw
  bool head_known = false;         ///< the eyes' poses are of this frame
  bool recentred = false;          ///< L has moved, or the person asked for it
  bool start = false;              ///< the person pressed the button for it
  std::array<EyeView, 2> eyes;     ///< left, right
  std::array<HandInput, 2> hands;  ///< left, right
};

/// A picture to draw into: a two-dimensional texture of the context, rows from the bottom.
struct EyeTexture {
  std::uint32_t texture = 0;
  std::int64_t format = 0;  ///< OpenGL's internal format
  int width = 0, height = 0;
};

/// What is really there behind the drawn picture. opaque: nothing. additive: half-silvered glass,
/// black is clear. alpha: the picture's alpha, premultiplied.
enum class Blend { opaque, additive, alpha };

/// waiting: not on a head yet, or its system shows something else. silent: its runtime does not
/// answer; the headset comes back when it does. lost: for good.
enum class HeadsetState { waiting, running, silent, lost };

/// How a frame is made:  begin() waits for its time and says what is to be seen;  end(draw) has
/// both eyes drawn and shown. What goes wrong with a headset in use is never thrown: its state is
/// `silent` or `lost`, `trouble` says why, and whoever uses it goes on without. One thread, which
/// no call holds up for longer than HeadsetPatience says, whatever the runtime does.
class Headset {
 public:
  using Draw = std::function<void(std::size_t eye, const EyeTexture& picture)>;

  virtual ~Headset() = default;
  /// Nothing while it is not running, and where its next frame does not come in time: later calls
  /// wait for it then, and not at all once it is silent.
  virtual std::optional<HeadsetFrame> begin() = 0;
  /// After every begin() that gave a frame; an empty `draw` shows nothing.
  virtual void end(const Draw& draw) = 0;
  /// Dropped where the runtime is still at something else.
  virtual void vibrate(std::size_t hand, double seconds, double strength) = 0;  ///< strength 0..1
  virtual HeadsetState state() const = 0;
  virtual Blend blend() const = 0;
  virtual const std::array<EyeView, 2>& eyes() const = 0;  ///< sizes are known from the beginning
  virtual std::string describe() const = 0;                ///< the runtime's and the system's names
  virtual std::string trouble() const = 0;  ///< why it is silent or lost, in words; or empty
  virtual int silences() const = 0;         ///< how often it became silent
};

/// Opens the headset of the computer's OpenXR runtime. Throws Error when there is no runtime, no
/// headset, nothing that both sides can do, or no answer.
std::unique_ptr<Headset> openHeadset(const GlBinding& gl, const HeadsetPatience& patience = {});

}  // namespace palpa::ar
