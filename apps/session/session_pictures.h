#pragma once

#include <memory>
#include <string>
#include <vector>

#include "apps/runtime/camera_activity.h"
#include "apps/runtime/clock.h"
#include "apps/runtime/room_film.h"
#include "apps/session/session_options.h"
#include "apps/twin/virtual_bench.h"
#include "ar/cameras/webcam.h"

namespace palpa::session {

/// One registered (or not) recorded picture, for registration.csv.
struct RegistrationRow {
  std::string source;
  int points = 0;
  double rms_px = 0;
  Pose X_CW = Pose::Identity();
};

/// Where a session's pictures come from, and what board is looked for in them: the bench's camera,
/// the station's webcam, a film, or photographs one after the other, over and over. With
/// `--tracking model` nothing: a model of what would be found in the bench's pictures. Throws
/// UsageError when pictures and intrinsics do not fit, a webcam is to be watched in virtual time,
/// or the station has what the model does not know.
class SessionPictures {
 public:
  SessionPictures(const SessionOptions& options, const station::Station& station);
  ~SessionPictures();

  bool fromBench() const { return source_ == Source::bench; }
  bool photographs() const { return source_ == Source::photographs; }
  const calibration::CameraModel& camera() const { return camera_; }
  const ar::Board& board() const { return *board_; }
  /// `bench`: asked only where its camera is watched.
  runtime::CameraActivity::Settings settings(runtime::TimeMode mode,
                                             const twin::VirtualBench* bench) const;
  /// `bench` is asked only where its camera is watched; `clock`: the session's.
  runtime::CameraActivity::Exposer exposer(twin::VirtualBench* bench, const runtime::Clock& clock);
  runtime::CameraActivity::Observer observer(twin::VirtualBench* bench);
  /// Of photographs
  const std::vector<RegistrationRow>& registration() const { return registration_; }
  std::vector<std::string> remarks() const;  ///< what a webcam's driver did not accept, in words

 private:
  enum class Source { bench, webcam, film, photographs };
  std::optional<ar::Frame> take(std::int64_t now_ns, std::uint64_t number,
                                const runtime::Clock& clock);
  std::unique_ptr<ar::Camera> opened() const;
  void readModel();
  void note(const runtime::CameraView& view);

  const station::Station& station_;
  std::string file_;  ///< pattern or film
  Source source_ = Source::bench;
  calibration::CameraModel camera_;
  double rate_Hz_;
  std::optional<twin::TrackingFigures> model_;  ///< in place of the bench's pictures
  const bool seen_;                             ///< by somebody besides the tracker
  std::unique_ptr<ar::Camera> pictures_;        ///< null: the bench's, or a webcam that is not open
  std::size_t photographs_ = 0;
  std::unique_ptr<ar::Board> board_;
  std::vector<RegistrationRow> registration_;
};

/// The film of the room, by the camera that is named or out of another film, into this folder;
/// null: nobody wanted one. The clock outlives it. Throws UsageError for the station's own camera,
/// Error where it cannot be written.
std::unique_ptr<runtime::RoomFilm> roomFilm(const SessionOptions& options,
                                            const station::Station& station,
                                            const std::filesystem::path& folder,
                                            const runtime::Clock& clock);

}  // namespace palpa::session
