#include <AL/al.h>
#include <AL/alc.h>
#include <AL/alext.h>

#include <array>
#include <cstdlib>
#include <filesystem>
#include <utility>
#include <vector>

#include "anatomy/base/error.h"
#include "apps/sound/loudspeaker.h"
#include "apps/sound/tones.h"

namespace palpa::sound {
namespace {

constexpr const char* kWhere = "No sound device";
constexpr const char* kAdvice =
    "Connect loudspeakers or headphones, or look at the sound settings of this computer";

struct CloseDevice {
  void operator()(ALCdevice* device) const { alcCloseDevice(device); }
};
struct DestroyContext {
  void operator()(ALCcontext* context) const { alcDestroyContext(context); }
};
using Device = std::unique_ptr<ALCdevice, CloseDevice>;
using Context = std::unique_ptr<ALCcontext, DestroyContext>;

Device openDevice() {
  Device device(alcOpenDevice(nullptr));
  if (!device) throw Error("the system has none that could be played on", kWhere, kAdvice);
  return device;
}

/// As few samples at once as it takes: what is asked for, not what is got.
Context makeContext(ALCdevice* device) {
  const std::array<ALCint, 5> asked{ALC_FREQUENCY, kRate_Hz, ALC_REFRESH, 100, 0};
  Context context(alcCreateContext(device, asked.data()));
  if (!context) throw Error("the system's refuses to play", kWhere, kAdvice);
  return context;
}

/// A context of this thread alone, so that one that is left behind is in no other's way.
class ThreadsContext {
 public:
  explicit ThreadsContext(ALCdevice* device) {
    void* const found = alcIsExtensionPresent(device, "ALC_EXT_thread_local_context")
                            ? alcGetProcAddress(device, "alcSetThreadContext")
                            : nullptr;
    set_ = found ? reinterpret_cast<PFNALCSETTHREADCONTEXTPROC>(found) : &alcMakeContextCurrent;
  }
  bool set(ALCcontext* context) const { return set_(context) == ALC_TRUE; }

 private:
  PFNALCSETTHREADCONTEXTPROC set_ = nullptr;
};

class OpenAlOutput final : public Output {
 public:
  OpenAlOutput()
      : device_(openDevice()), context_(makeContext(device_.get())), current_(device_.get()) {
    if (!current_.set(context_.get())) throw Error("the system's refuses to play", kWhere, kAdvice);
    watched_ = alcIsExtensionPresent(device_.get(), "ALC_EXT_disconnect") == ALC_TRUE;
    alGenSources(1, &source_);
    alGenBuffers(static_cast<ALsizei>(free_.size()), free_.data());
    if (alGetError() != AL_NO_ERROR) {
      current_.set(nullptr);
      throw Error("the system's refuses to play", kWhere, kAdvice);
    }
    buffers_ = free_;
  }
  ~OpenAlOutput() override {
    alSourceStop(source_);
    alDeleteSources(1, &source_);
    alDeleteBuffers(static_cast<ALsizei>(buffers_.size()), buffers_.data());
    current_.set(nullptr);
  }
  OpenAlOutput(const OpenAlOutput&) = delete;
  OpenAlOutput& operator=(const OpenAlOutput&) = delete;

  std::string name() const override {
    const bool by_its_own =
        alcIsExtensionPresent(device_.get(), "ALC_ENUMERATE_ALL_EXT") == ALC_TRUE;
    const char* const name =
        alcGetString(device_.get(), by_its_own ? ALC_ALL_DEVICES_SPECIFIER : ALC_DEVICE_SPECIFIER);
    return name ? name : "a sound device";
  }

  std::optional<int> room() override {
    if (watched_) {
      ALCint is_there = 1;
      alcGetIntegerv(device_.get(), ALC_CONNECTED, 1, &is_there);
      if (!is_there) throw Error("the one that played is gone", kWhere, kAdvice);
    }
    takeBack();
    if (free_.empty()) return std::nullopt;
    ALint queued = 0, played = 0;
    alGetSourcei(source_, AL_BUFFERS_QUEUED, &queued);
    alGetSourcei(source_, AL_SAMPLE_OFFSET, &played);
    return queued * Loudspeaker::kBlock - played;
  }

  void write(std::span<const std::int16_t> block) override {
    const ALuint buffer = free_.back();
    free_.pop_back();
    alBufferData(buffer, AL_FORMAT_MONO16, block.data(), static_cast<ALsizei>(block.size_bytes()),
                 kRate_Hz);
    alSourceQueueBuffers(source_, 1, &buffer);
    ALint state = AL_PLAYING;
    alGetSourcei(source_, AL_SOURCE_STATE, &state);
    if (state != AL_PLAYING && free_.empty()) alSourcePlay(source_);
  }

 private:
  /// What has been played. A source that ran dry has stopped, and would take for played whatever is
  /// queued then: it begins anew.
  void takeBack() {
    ALint played = 0, state = AL_PLAYING;
    alGetSourcei(source_, AL_SOURCE_STATE, &state);
    alGetSourcei(source_, AL_BUFFERS_PROCESSED, &played);
    for (; played > 0; --played) {
      ALuint buffer = 0;
      alSourceUnqueueBuffers(source_, 1, &buffer);
      free_.push_back(buffer);
    }
    if (state == AL_STOPPED) alSourceRewind(source_);
  }

  const Device device_;
  const Context context_;
  const ThreadsContext current_;
  bool watched_ = false;  ///< whether it is still there can be asked
  ALuint source_ = 0;
  std::vector<ALuint> free_ = std::vector<ALuint>(Loudspeaker::kBlocks), buffers_;
};

}  // namespace

std::unique_ptr<Output> openUsualOutput() { return std::make_unique<OpenAlOutput>(); }

/// ALSA's own words cannot be turned off by a setting: where this computer has no sound card at
/// all, it is not asked, nor is sndio, which asks it.
void keepSoundLibrariesQuiet() {
  constexpr int kKeepWhatIsSet = 0;
  setenv("ALSOFT_LOGLEVEL", "0", kKeepWhatIsSet);
  std::error_code none;
  if (!std::filesystem::exists("/dev/snd", none))
    setenv("ALSOFT_DRIVERS", "-alsa,-sndio,", kKeepWhatIsSet);
}

}  // namespace palpa::sound
