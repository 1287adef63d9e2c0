#pragma once

#include <memory>
#include <variant>
#include <vector>

#include "apps/runtime/channels.h"
#include "apps/runtime/flight_sink.h"
#include "apps/runtime/stop_switch.h"
#include "ar/cameras/camera.h"
#include "ar/tracking/board_tracker.h"
#include "haptics/loop/tick_state.h"

namespace palpa::runtime {

/// The needle as the haptic loop last computed it, for the slower activities.
struct ToolState {
  std::int64_t t_ns = 0;
  PackedPose X_DT;
  Packed3 v_D{};  ///< of the tip, m/s
  Packed3 f_contact_D{}, f_command_D{};
  Packed3 entry_D{};
  double depth = 0, plunger = 0, bone_force = 0;
  haptics::NeedlePhase phase = haptics::NeedlePhase::outside;
  Tissue tissue = Tissue::air;
  Organ wall = Organ::none, bone = Organ::none;
  haptics::SafetyCause safety = haptics::SafetyCause::none;
  bool homed = false;
  Packed3 f_sensed_D{};  ///< of a real object on the tool, N; zero where no sensor can say
};

/// What the camera saw last, as it came (distorted).
struct CameraView {
  std::int64_t t_exposure_ns = 0;
  std::uint64_t number = 0;
  std::string source;
  std::shared_ptr<const cv::Mat> picture;
  /// as measured in this picture; empty when the board is not seen in it
  std::optional<ar::BoardPose> pose;
  /// Of the board at the exposure: filtered over the pictures, or predicted where it is hidden for
  /// a moment
  std::optional<Pose> X_CW;
  ar::TrackState tracking = ar::TrackState::searching;
  /// X_CW and `tracking` are of another tracking system than the pictures
  bool by_tracker = false;
  ar::PictureFault fault = ar::PictureFault::none;  ///< gone: `source` says why
  std::vector<std::optional<Pose>>
      /// X_CB of the boards besides the table's, as `X_CW`, in the order of the camera's settings;
      /// empty: not seen
      others;
};

/// What a person at the display sees, as far as a simulated person may know it.
struct Displayed {
  std::int64_t t_ns = 0;
  Pose X_AT = Pose::Identity();  ///< the needle as drawn on the drawn patient
  int trial = 0;
  bool running = false;
  Tissue flows = Tissue::air;           ///< whose blood or air enters the syringe
  bool injury = false;                  ///< lung or artery: the screen says so
  Pose second_X_AT = Pose::Identity();  ///< another tool, where there is one
  enum class Question : std::uint8_t {
    none,
    harder,
    heavier,
    aspirated,
    rougher,
    order,  ///< from the smoothest to the roughest
    pulse_place,
    pulse_count,   ///< it is counted now
    pulse_number,  ///< how many beats were counted
    pulse_rhythm
  } question = Question::none;  ///< that the screen asks
  int things = 0;               ///< between which one chooses, or that are put in order
};

/// Where the camera was, without its picture.
struct CameraPose {
  std::int64_t t_ns = 0;     ///< of the exposure
  std::optional<Pose> X_CW;  ///< as in CameraView
};

/// The camera's pose as a tracking system measured it, in place of the table's board.
struct TrackedPose {
  std::int64_t t_ns = 0;  ///< session time of the measurement
  Pose X_CW = Pose::Identity();
};

struct Keyframe {
  std::int64_t tick = 0;
  haptics::TickState state;
};

using EvidenceMessage = std::variant<Event, TrialHeader, TrialEnd>;

/// Everything that passes between activities: state is latest-wins, events are queued. Each channel
/// has one writer and one reader, named `<writer>_to_<reader>`; the emergency stop alone has many.
struct Bus {
  explicit Bus(TimeMode mode)
      : geometry_to_haptic(mode),
        haptic_to_geometry(mode),
        haptic_to_scene(mode),
        second_to_scene(mode),
        task_to_haptic(mode),
        camera_to_scene(mode),
        camera_to_task(mode),
        haptic_to_link(mode),
        second_to_link(mode),
        camera_to_link(mode),
        scene_to_operator(mode) {}

  StopSwitch stop;  ///< pressed by anybody, read by the haptic thread and the task

  StateChannel<LocalGeometry> geometry_to_haptic;
  StateChannel<ToolState> haptic_to_geometry, haptic_to_scene;
  /// of the second of two devices; silent where there is one
  StateChannel<ToolState> second_to_scene;
  StateChannel<haptics::TickCommands> task_to_haptic;
  StateChannel<CameraView> camera_to_scene, camera_to_task;
  StateChannel<ToolState> haptic_to_link,
      second_to_link;  ///< link: other programs that listen; nobody reads where none may
  StateChannel<CameraPose> camera_to_link;
  StateChannel<Displayed> scene_to_operator;

  EventQueue<haptics::FlightRecord> haptic_to_recorder{8192}, haptic_to_task{8192};
  EventQueue<Keyframe> keyframes_to_recorder{128};
  EventQueue<LocalGeometry> geometry_to_recorder{512};
  EventQueue<EvidenceMessage> task_to_recorder{1024};
  EventQueue<Event> device_to_task{64};  ///< what a driver has to tell
  EventQueue<EvidenceMessage> recorder_to_link{256};
  EventQueue<TrackedPose> tracker_to_camera{512};
};

}  // namespace palpa::runtime
