#include <algorithm>
#include <cstdlib>
#include <exception>
#include <utility>

#include "anatomy/base/error.h"
#include "anatomy/base/left_behind.h"
#include "ar/headset/xr_frames.h"
#include "ar/headset/xr_thread.h"

namespace palpa::ar {
namespace {

constexpr const char* kSilence = "the headset's runtime does not answer";
constexpr const char* kNoContext =
    "the graphics driver does not let the headset's pictures be drawn";

/// What the runtime's thread works with while it is busy, and its user while it is not.
struct XrShared {
  GlBinding gl;
  bool has_context = false;
  std::unique_ptr<XrFrames> frames;
  std::exception_ptr refusal;
};

void openFrames(XrShared& shared) {
  try {
    if (!shared.has_context) throw Error(kNoContext, "headset", "Update the graphics driver");
    shared.frames = std::make_unique<XrFrames>(shared.gl);
  } catch (...) {
    shared.refusal = std::current_exception();
  }
}

void closeFrames(XrShared& shared) {
  shared.frames->finish();
  shared.frames.reset();
}

class XrHeadset final : public Headset {
 public:
  XrHeadset(const GlBinding& gl, const HeadsetPatience& patience)
      : patience_(patience), shared_(std::make_shared<XrShared>()) {
    shared_->gl = gl;
    start(openFrames);
    if (!thread_.wait(patience_.opening)) {
      leaveBehind(shared_);
      throw Error(kSilence, "headset", "Start the headset's own software again");
    }
    if (shared_->refusal) std::rethrow_exception(std::exchange(shared_->refusal, nullptr));
    blend_ = shared_->frames->blend();
    name_ = shared_->frames->name();
    frame_ = shared_->frames->frame();
  }

  ~XrHeadset() override {
    if (!silent_) thread_.wait(patience_.silent);
    if (!thread_.busy()) {
      start(closeFrames);
      thread_.wait(patience_.closing);
    }
    if (thread_.busy()) leaveBehind(shared_);
  }

  std::optional<HeadsetFrame> begin() override {
    const bool late = beginning_ && !silent_;
    if (!answered()) return std::nullopt;
    if (late && shared_->frames->ready()) return taken();
    if (state_ == HeadsetState::lost) return std::nullopt;
    beginning_ = true;
    if (!run([](XrFrames& frames) { frames.next(); })) return std::nullopt;
    return taken();
  }

  void end(const Draw& draw) override {
    if (!answered() || !shared_->frames->ready()) return;
    const bool drawn = draw && shared_->frames->canDraw();
    if (drawn) drawBoth(draw);
    run([drawn](XrFrames& frames) { frames.show(drawn); });
  }

  void vibrate(std::size_t hand, double seconds, double strength) override {
    if (silent_ || thread_.busy() || state_ != HeadsetState::running) return;
    run([=](XrFrames& frames) { frames.vibrate(hand, seconds, strength); });
  }

  HeadsetState state() const override { return silent_ ? HeadsetState::silent : state_; }
  Blend blend() const override { return blend_; }
  const std::array<EyeView, 2>& eyes() const override { return frame_.eyes; }
  std::string describe() const override { return name_; }
  std::string trouble() const override {
    if (!silent_) return trouble_;
    return std::string(kSilence).append("; the session goes on without it");
  }
  int silences() const override { return silences_; }

 private:
  /// With the context, which the calling thread gives up for it.
  template <class Step>
  void start(Step step) {
    letGoOfContext(shared_->gl);
    thread_.start([shared = shared_, step] {
      shared->has_context = takeContext(shared->gl);
      if (!shared->has_context && shared->frames) shared->frames->lose(kNoContext);
      step(*shared);
      letGoOfContext(shared->gl);
    });
  }

  /// Whether it was done in time.
  template <class Calls>
  bool run(Calls calls) {
    start([calls](XrShared& shared) { calls(*shared.frames); });
    return answered();
  }

  /// Whether the runtime's thread has done what it was given; waits for it, but not for one that is
  /// silent.
  bool answered() {
    const auto left = patience_.silent - thread_.waitedInVain();
    if (!thread_.wait(silent_ ? left.zero() : std::min(patience_.frame, left))) {
      if (!silent_ && thread_.waitedInVain() >= patience_.silent) {
        silent_ = true;
        ++silences_;
      }
      return false;
    }
    silent_ = false;
    state_ = shared_->frames->state();
    trouble_ = shared_->frames->trouble();
    return true;
  }

  std::optional<HeadsetFrame> taken() {
    beginning_ = false;
    if (!shared_->frames->ready()) return std::nullopt;
    frame_ = shared_->frames->frame();
    return frame_;
  }

  void drawBoth(const Draw& draw) {
    try {
      for (std::size_t i = 0; i < 2; ++i) draw(i, shared_->frames->picture(i));
    } catch (const std::exception& failure) {
      shared_->frames->lose(failure.what());
    }
  }

  const HeadsetPatience patience_;
  std::shared_ptr<XrShared> shared_;
  XrThread thread_;
  bool beginning_ = false;  // the frame that begins was asked for and not taken yet
  bool silent_ = false;
  int silences_ = 0;
  HeadsetState state_ = HeadsetState::waiting;
  Blend blend_ = Blend::opaque;
  HeadsetFrame frame_;
  std::string name_, trouble_;
};

}  // namespace

std::unique_ptr<Headset> openHeadset(const GlBinding& gl, const HeadsetPatience& patience) try {
  setenv("XR_LOADER_DEBUG", "none", 0);  // what it would print is said in our words
  return std::make_unique<XrHeadset>(gl, patience);
} catch (const XrFailure& failure) {
  const XrWords words = inWords(failure);
  throw Error(words.what, "headset", words.advice);
}

}  // namespace palpa::ar
