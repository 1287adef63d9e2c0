#pragma once

#include <filesystem>
#include <functional>
#include <memory>
#include <optional>

#include "apps/runtime/activity.h"
#include "apps/runtime/board_places.h"
#include "apps/runtime/bus.h"
#include "apps/runtime/head_display.h"
#include "apps/station/real_things.h"
#include "apps/task_needle/needle_task.h"
#include "apps/task_needle/skin_follower.h"
#include "apps/task_needle/task_status.h"
#include "ar/undistort.h"
#include "scene/scene_view.h"

namespace palpa::task_needle {

/// A real thing in the camera's picture; both outlive the session. Boards: of the camera's other boards.
struct RealThing {
  const anatomy::TriangleMesh* mesh = nullptr;
  const station::RealThing* place = nullptr;
};

struct SavedPicture {
  std::filesystem::path file;
  PictureRequest moment;
};

/// SCENE, 30 Hz (as often as a headset asks): puts together what is seen, shows it (or only when a picture is wanted, or never), and
/// tells a simulated person what is on the screen. Keys and mouse of a window come back through here.
class SceneActivity final : public runtime::Activity {
 public:
  enum class Views { none, pictures, continuous };
  struct Setup {
    Views views = Views::none;
    scene::SceneView* view = nullptr;      ///< null without views
    runtime::HeadDisplay* head = nullptr;  ///< null without one; while it shows, its frames set the pace
    calibration::CameraModel camera;
    Pose X_WA = Pose::Identity(), X_WD = Pose::Identity();
    std::string mark;                      ///< "SIMULATED OPERATOR", ...
    std::filesystem::path folder;          ///< where view-*.png go
    bool every_source_picture = false;     ///< recorded pictures: keep one overlay for each of them
    std::int64_t display_latency_ns = 33'000'000;
    /// The skin is shown to give way (surface `skin` of this patient); null: it is not.
    const anatomy::SurfaceQuery* giving_way = nullptr;
    int skin = 0;
    /// Covariance in A of the drawn tip against the real one, at X_DT: shown as an ellipse, and told; empty, or nothing: it is not known.
    std::function<std::optional<Mat3>(const Pose& X_DT)> tip_covariance_A;
    std::optional<scene::Guide> guide;
    std::vector<RealThing> things;
    std::vector<runtime::BoardPlace> places;   ///< of the boards besides the table's
    /// Keys and mouse of a window, once a frame.
    std::function<void(const scene::ViewInput&, std::int64_t now_ns)> input;
  };
  SceneActivity(const Setup& setup, runtime::Bus& bus, TaskChannels& channels);

  const char* name() const override { return "scene"; }
  std::int64_t step(std::int64_t now_ns) override;
  /// After the executive has stopped: pictures still wanted.
  void finish(std::int64_t now_ns);

  const std::vector<SavedPicture>& pictures() const { return pictures_; }
  /// The board as it was seen last.
  const std::optional<ar::BoardPose>& board() const { return board_; }
  void cycleSkin();

 private:
  void follow(std::int64_t now_ns);
  void compose();
  void showOnHead();
  void hideBehindRealThings();
  void render();
  void keepPictures();
  void save(const std::string& stem, const PictureRequest& moment);
  void tellOperator(std::int64_t now_ns);

  Setup setup_;
  runtime::Bus& bus_;
  TaskChannels& channels_;
  ar::Undistorter undistorter_;
  Pose X_AD_;
  TaskStatus status_;
  runtime::ToolState tool_;
  std::optional<runtime::CameraView> camera_;
  std::optional<ar::BoardPose> board_;
  Pose X_CW_ = Pose::Identity();
  bool registered_ = false, fresh_picture_ = false;
  std::int64_t now_ns_ = 0, next_frame_ns_ = 0;
  std::uint64_t last_number_ = ~0ull;
  scene::Image background_;
  scene::SceneState state_;
  std::optional<SkinFollower> skin_;
  std::vector<SavedPicture> pictures_;
  std::vector<std::string> kept_sources_;
  std::optional<std::size_t> displaced_;   ///< the board that is told to be
  runtime::ToolState felt_;    ///< what the hand in a headset was last told
  int trail_trial_ = 0;
};

}  // namespace palpa::task_needle
