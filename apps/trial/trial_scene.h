#pragma once

#include <filesystem>
#include <functional>
#include <memory>
#include <optional>

#include "apps/presentation/presentation.h"
#include "apps/runtime/activity.h"
#include "apps/runtime/bus.h"
#include "apps/runtime/camera_trouble.h"
#include "apps/station/station_sections.h"
#include "apps/trial/hud_words.h"
#include "apps/trial/look_watch.h"
#include "apps/trial/picture_writer.h"
#include "apps/trial/trial_status.h"
#include "ar/cameras/undistort.h"
#include "scene/head_display.h"
#include "scene/scene_state.h"
#include "scene/view/scene_view.h"

namespace palpa::trial {

/// Takes away what the presentation does not show, whatever the task has put together: forces,
/// trail, lines and rings that lead, the map of what was felt, lumps and the tip's ellipse seen
/// through the skin, and the words for each; gives the skin its look. What there would be without a
/// simulator stays: tool, blood, time, trial, marks that were made, notices.
void keepShown(const presentation::Presentation& shown, scene::SceneState* state);

/// The skin as it is shown at first, and after the trainee's key: that changes only a free one.
scene::SkinStyle firstSkin(const presentation::Presentation& shown);
scene::SkinStyle nextSkin(const presentation::Presentation& shown, scene::SkinStyle now);

/// A real thing in the camera's picture; both outlive the session. Boards: of the camera's other
/// boards.
struct PlacedThing {
  const anatomy::TriangleMesh* mesh = nullptr;
  const station::RealThing* place = nullptr;
};

struct SavedPicture {
  std::filesystem::path file;
  PictureRequest moment;
};

/// SCENE, 30 Hz (as often as a headset asks): puts together what is seen, shows it (or only when a
/// picture is wanted, or never), and tells a simulated person what is on the screen. Keys and mouse
/// of a window come back through here. What is particular to a task adds whoever derives from this.
class TrialScene : public runtime::Activity {
 public:
  enum class Views { none, pictures, continuous };
  struct Stage {
    Views views = Views::none;
    /// Whether somebody wants to see this frame, asked before each; empty: nobody.
    std::function<bool(std::int64_t now_ns)> wanted;
    scene::SceneView* view = nullptr;  ///< null without views
    /// null without one; while it shows, its frames set the pace
    scene::HeadDisplay* head = nullptr;
    calibration::CameraModel camera;
    Pose X_WA = Pose::Identity(), X_WD = Pose::Identity();
    std::string mark;                   ///< "SIMULATED OPERATOR", ...
    presentation::Presentation shown;   ///< what may be seen of all that a task puts together
    std::filesystem::path folder;       ///< where view-*.png go
    bool every_source_picture = false;  ///< recorded pictures: keep one overlay for each of them
    std::int64_t display_latency_ns = 33'000'000;
    /// Covariance in A of the drawn tip against the real one, at X_DT: shown as an ellipse, and
    /// told; empty, or nothing: it is not known.
    std::function<std::optional<Mat3>(const Pose& X_DT)> tip_covariance_A;
    std::vector<PlacedThing> things;
    std::vector<runtime::BoardPlace> places;  ///< of the boards besides the table's
    /// adds last what no task shows: a replay's strip
    std::function<void(scene::SceneState&)> more;
    /// Told after every frame what is on the screen, and where the trials stand.
    std::function<void(const scene::SceneState&, const TrialStatus&, std::int64_t now_ns)> watch;
    std::vector<scene::KeyHelp> keys;  ///< shown while somebody asks for them
    /// Keys and mouse of a window, once a frame.
    std::function<void(const scene::ViewInput&, std::int64_t now_ns)> input;
  };
  TrialScene(const Stage& stage, runtime::Bus& bus, Channels& channels);

  const char* name() const override { return "scene"; }
  std::int64_t step(std::int64_t now_ns) override;
  /// After the executive has stopped: pictures still wanted; returns when all are written.
  void finish(std::int64_t now_ns);

  const std::vector<SavedPicture>& pictures() const { return pictures_; }
  /// The board as it was seen last.
  const std::optional<ar::BoardPose>& board() const { return board_; }

 protected:
  /// Reads the task's status; told before anything is composed.
  virtual const TrialStatus& readStatus(std::int64_t now_ns) = 0;
  /// Adds to the state what only this task shows; camera, tool, real things and the tip's ellipse
  /// are in it. `trouble`: of camera or headset, in words.
  virtual void compose(scene::SceneState& state, const runtime::ToolState& tool,
                       const std::string& trouble) = 0;
  /// Adds to what a simulated person sees.
  virtual void addTo(runtime::Displayed&, const runtime::ToolState&) {}
  /// What a controller of a headset can make felt.
  virtual void pulse(scene::HeadDisplay&, const runtime::ToolState&) {}
  /// A headset's frame may be waited for.
  virtual bool mayWait(const runtime::ToolState&) const { return true; }

  std::int64_t now_ns() const { return now_ns_; }
  const Pose& X_AD() const { return X_AD_; }
  const std::string& mark() const { return stage_.mark; }
  const presentation::Presentation& shown() const { return stage_.shown; }

 private:
  void handle(const scene::ViewInput& input);
  void follow(std::int64_t now_ns);
  std::string trouble();
  void composeAll();
  void showEllipse(bool camera_good);
  void hideBehindRealThings();
  cv::Rect placeOfBoard() const;
  void render();
  void keepPictures();
  void save(const std::string& name, const PictureRequest& moment);
  void informOperator(std::int64_t now_ns);

  Stage stage_;
  runtime::Bus& bus_;
  Channels& channels_;
  ar::Undistorter undistorter_;
  Pose X_AD_;
  const TrialStatus* status_ = nullptr;
  runtime::ToolState tool_;
  std::optional<runtime::CameraView> camera_;
  std::optional<ar::BoardPose> board_;
  Pose X_CW_ = Pose::Identity();
  bool registered_ = false, fresh_picture_ = false, help_ = false;
  std::int64_t now_ns_ = 0, next_frame_ns_ = 0;
  std::uint64_t last_number_ = ~0ull;
  scene::Image background_;
  scene::SceneState state_;
  std::vector<SavedPicture> pictures_;
  std::vector<std::string> kept_sources_;
  std::optional<std::size_t> displaced_;  ///< the board that is told to be
  LookWatch look_;
  PictureWriter writer_;
};

}  // namespace palpa::trial
