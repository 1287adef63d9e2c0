#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <string>

#include "apps/runtime/activity.h"
#include "apps/runtime/clock.h"
#include "apps/runtime/recorders.h"
#include "ar/cameras/camera.h"

namespace palpa::runtime {

/// ROOM FILM: what a second camera sees of the person and the station, for talking a trial over
/// afterwards: a `PictureFile` "room" beside the evidence, eight pictures a second, at most 640
/// wide. Nothing is measured in it. A camera that fails is asked again once a second, and a full
/// disk ends the film; neither stops the session, nor does a camera that never answers hold up its
/// end.
class RoomFilm final : public Activity {
 public:
  using Open = std::function<std::unique_ptr<ar::Camera>()>;
  /// `waits`: the camera gives its pictures at its own pace, with a driver's stamps, and may hang:
  /// it is asked on a thread of its own. Else it is asked for one when one is due. `clock` outlives
  /// it. Throws Error where the files cannot be made.
  RoomFilm(const Open& open, bool waits, const std::filesystem::path& folder, const Clock& clock);
  ~RoomFilm() override;
  const char* name() const override { return "room film"; }
  std::int64_t step(std::int64_t now_ns) override;

  std::uint64_t pictures() const { return file_.pictures(); }  ///< once it is over
  std::string trouble() const;  ///< of the camera or the disk, the last; empty: none
  std::string news();           ///< a trouble that was not told yet; empty: none. Any thread

 private:
  struct Asked;
  void keep(const ar::Frame& frame, std::int64_t t_ns);

  const std::shared_ptr<Asked> asked_;
  const bool waits_;
  const Clock& clock_;
  PictureFile file_;
  std::int64_t kept_ns_ = -1;
};

}  // namespace palpa::runtime
