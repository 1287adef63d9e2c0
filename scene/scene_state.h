#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "anatomy/geometry/pose.h"
#include "anatomy/geometry/top_shape.h"
#include "anatomy/patient.h"
#include "anatomy/query/skin_dimple.h"

/// Everything the scene needs for one frame: plain numbers and pixels, no devices, no trackers.
namespace palpa::scene {

struct Image {
  int width = 0, height = 0, channels = 3;
  std::vector<std::uint8_t> pixels;  ///< rows top to bottom, RGB
};

/// Pinhole without distortion; pixel centres at whole numbers (OpenCV).
struct Pinhole {
  int width = 640, height = 480;
  double fx = 600, fy = 600, cx = 319.5, cy = 239.5;
};

/// What a camera makes of what it sees, measured in its picture; levels and grain of 1.
struct CameraLook {
  double blur_px = 0;  ///< sigma of a Gaussian, pixels of the picture
  std::array<double, 3> black{0, 0, 0}, white{1, 1, 1};  ///< of black and of white things
  std::array<double, 5> grain{};  ///< standard deviation of a pixel, evenly from black to white
  double grain_neighbours = 0;    ///< correlation of a pixel's grain with the next one's, to 0.5
  double grain_colour = 1;        ///< 0: alike in all channels; 1: each has its own
};

/// A camera of one eye.
struct EyeCamera {
  Pinhole camera;
  Pose X_CA = Pose::Identity();
};

/// weight, friction: what does not press back, of what is held and of what is stroked; felt: all of
/// them
enum class ForceKind { reaction, weight, friction, device, felt };
/// paper: grays, as Jeon, Choi and Harders (2015) have them. safe: colours of Okabe and Ito (2008),
/// told apart by colour-blind eyes and by brightness.
enum class ForceColours { paper, safe };

struct ForceArrow {
  ForceKind kind = ForceKind::device;
  Vec3 p_A = Vec3::Zero();
  Vec3 f_A = Vec3::Zero();  ///< newtons
};

/// What is held in the hand, as the tool frame T carries it (scene/actors/instrument.h).
enum class Tool { needle, probe };

/// A real thing in the picture, at a place in A. The mesh outlives the view that shows it and does
/// not change.
struct Occluder {
  const anatomy::TriangleMesh* mesh = nullptr;
  Pose X_A = Pose::Identity();
};

/// A line to follow: from where the needle enters to what it shall reach.
struct GuideLine {
  Vec3 from_A = Vec3::Zero(), to_A = Vec3::Zero();
};

/// What of an area has been felt, and how firmly: a grid on a top in G, as seen along z, centred on
/// G's origin, columns along x, rows along y.
struct CoverageGrid {
  static constexpr std::uint8_t kNotAsked = 255;  ///< level of a cell outside of the area
  Pose X_AG = Pose::Identity();
  double cell_x = 0.004, cell_y = 0.004;  ///< metres
  int columns = 0, rows = 0;
  /// row by row from the lowest y; 0: not felt, 1 light, 2 medium, 3 deep
  std::vector<std::uint8_t> levels = {};
  TopShape top = {};  ///< flat: the plane z = 0
  /// M, corner after corner, once around what is drawn about; none: the whole grid
  std::vector<Eigen::Vector2d> outline = {};
};

/// A figure all over a surface, in colours: nodes of a grid in the plane z = 0 of G, columns along
/// x, rows along y.
struct SurfaceMap {
  Pose X_AG = Pose::Identity();
  double low_x = 0, low_y = 0, step_x = 0.004, step_y = 0.004;  ///< m; the first node
  int columns = 0, rows = 0;
  std::vector<float> values;         ///< row by row from the lowest y
  std::vector<std::uint8_t> unsure;  ///< of each node; 1: it is hardly known
  std::string title, unit;           ///< of the legend: "Stiffness", "N/mm"
};

/// What the colours of a map mean, from one end to the other.
struct ColourScale {
  std::string title, low, high;  ///< "Stiffness", "0.12", "0.31 N/mm"
  bool any_unsure = false;
  bool operator==(const ColourScale&) const = default;
};

/// Something that lies inside, seen through the surface.
struct ShownLump {
  Vec3 p_A = Vec3::Zero();  ///< its middle
  double radius = 0.005;    ///< metres
  bool found = false;
  bool normal = false;  ///< belongs there: neither found nor missed
};

/// How two eyes see it. side_by_side, top_bottom: for screens that halve a picture and stretch each
/// half over all of it; anaglyph: for red and cyan glasses. headset: side by side, not squeezed,
/// words before each eye.
enum class Stereo { none, side_by_side, top_bottom, anaglyph, headset };

/// A small picture in the corner of the large view. camera: what the camera sees, without the
/// overlay.
enum class Inset { none, camera };

enum class SkinStyle { solid, translucent, hidden };

/// Of a patient: from the front, from the side, from the top.
inline constexpr int kFixedViews = 3;

/// What a mark on a strip means; also its height, so that colour does not stand alone.
enum class TickTone { neutral, good, guide, bad };

/// A strip along the bottom of the large view: where in a recorded trial one is, and what happened
/// when. Fractions of its length.
struct Timeline {
  struct Tick {
    double at = 0;
    TickTone tone = TickTone::neutral;
    bool operator==(const Tick&) const = default;
  };
  double at = 0;
  std::vector<Tick> ticks;
  std::string time;   ///< "0:12.4"
  std::string whole;  ///< " of 0:31.0", left out where the strip would be short
  std::string rate;   ///< "x 0.5", "paused"
  bool operator==(const Timeline&) const = default;
};

/// Words on the picture; empty lines are left out.
struct Hud {
  std::string phase;    ///< "Phase 1: puncture the skin"
  std::string depth;    ///< "12 mm inserted, in fat"
  std::string force;    ///< "1.2 N"
  std::string time;     ///< "0:31"
  std::string touched;  ///< "clavicle (guide)", "pleura!"
  std::string overlay;  ///< how far off the overlay may be at the needle's tip: "within 0.4 mm"
  std::string notice;   ///< one line of advice, loss of tracking, emergency stop
  std::string mark;     ///< "SIMULATED OPERATOR"
  bool alarm = false;   ///< notice in alarm style
  std::string marked;   ///< "2": how many lumps were marked
  std::string note;     ///< what to bear in mind: "scaled force: ..."
  std::optional<Timeline> timeline = {};  ///< of a replay
  std::optional<ColourScale> scale = {};  ///< of a map: the view fills it in
  std::string can_do = {};  ///< what a person can do now; smaller, and where there is no notice

  bool operator==(const Hud&) const = default;
};

/// How the words that are drawn are said: in the language of whoever looks. As it is drawn, so it
/// is measured. Chosen once for a process, before its first window; until then as they are.
using Wording = std::function<std::string(const std::string&)>;
void sayThrough(Wording wording);
std::string said(const std::string& english);

/// A key, or several, and what they do.
struct KeyHelp {
  std::string key, words;
  bool operator==(const KeyHelp&) const = default;
};

struct SceneState {
  const Image* picture = nullptr;  ///< undistorted camera picture; null: plain background
  const Image* beside = nullptr;   ///< what the inset shows; null: `picture`
  Pinhole camera;
  CameraLook look;          ///< that the overlay takes
  bool registered = false;  ///< X_CA is valid
  Pose X_CA = Pose::Identity();
  /// left and right, for a stereo view; empty: derived from the one camera
  std::optional<std::array<EyeCamera, 2>> eyes;
  /// tip of needle or probe at the origin of T, +z the way it advances
  Pose X_AT = Pose::Identity();
  Tool tool = Tool::needle;
  bool show_tool = true;
  bool shadows = true;       ///< of tools on the skin, and the ring where a needle went in
  bool smooth_edges = true;  ///< of what is drawn
  double plunger = 0;        ///< drawn fraction, 0..1
  double blood = 0;          ///< fraction of the syringe filled with blood, 0..1
  /// Whose: an artery's is bright, any other dark; the lung: bubbles rise.
  Tissue blood_of = Tissue::vein_lumen;
  SkinStyle skin = SkinStyle::translucent;
  int fixed_view = 0;  ///< which one, where one is shown at a time
  /// How a tool presses the skin in or draws it out; shown by views with
  /// `ViewLayout::skin_deflection`.
  std::optional<anatomy::SkinPush> skin_push;
  std::vector<ForceArrow> forces;
  std::vector<Vec3> trail_A;  ///< path of the tip so far
  std::optional<GuideLine> guide;
  /// of the drawn tip against the real one, m^2: shown as an ellipse
  std::optional<Mat3> tip_covariance_A;
  std::vector<Occluder> occluders;  ///< hide what is behind them while there is a picture
  Hud hud;
  /// a carpet on the surface; its outline shows what is to be searched
  std::optional<CoverageGrid> coverage;
  /// outlives the view that shows it and does not change; null: none. What has been felt is only
  /// outlined then
  const SurfaceMap* surface_map = nullptr;
  std::vector<ShownLump> lumps;
  /// where the trainee said "here is one": pins, numbered from 1 in this order
  std::vector<Vec3> marks_A;
  std::optional<Vec3> lead_A;  ///< where guidance asks the hand to go next: a ring on the surface
  std::optional<Pose> second_X_AT;  ///< another probe beside the tool
  /// Where the body is that is shown as made in A: a thing in the hands moves. AR view only, and
  /// not while it is translucent
  Pose X_AB = Pose::Identity();
  std::vector<KeyHelp> help;  ///< over the view while somebody asks; empty: nobody does
};

}  // namespace palpa::scene
