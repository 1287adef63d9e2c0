#pragma once

#include <functional>
#include <optional>
#include <string>

#include "anatomy/geometry/pose.h"
#include "ar/cameras/camera.h"
#include "haptics/device.h"
#include "haptics/sensors/force_sensor.h"

namespace palpa::runtime {

/// How a board is held before the camera: where its middle is in the picture (-1..1 across and
/// down), how it leans (rad, about the picture's horizontal and vertical), how much of the
/// picture's width it takes.
struct BoardFraming {
  double across = 0, down = 0;
  double lean = 0, turn = 0;
  double share = 0.5;
};

/// What somebody at a station is asked to do next. `words` are for a person; the rest says the same
/// in numbers.
struct Request {
  enum class What {
    show_board,  ///< hold the board before the camera, still
    touch,       ///< put the tip on `p_W` and press the button
    pivot,       ///< tilt the tool every way, its tip staying in the hole at `p_W`
    spin,        ///< spin the needle about itself in the hole at `p_W`
    hold,  ///< hold the tool still where `p_W` is, leaning by `lean`, its marker toward the camera,
           ///< and press the button
    wave,  ///< wave the tool, its marker toward the camera
    /// Press a soft sample with the round tip at `p_W` and let go, slowly and quickly, as deep as
    /// `depth`
    press,
    stroke,  ///< stroke over it, to and fro, as far as `reach`, at different depths and speeds
    /// Once: press it as deep as `depth`, hold, ease off a little, slide as far as `reach`, lift
    palpate,
  };
  What what = What::show_board;
  std::string words;
  Vec3 p_W = Vec3::Zero();
  Vec3 lean = Vec3::Zero();  ///< rad, of the tool against upright
  BoardFraming view;
  double seconds = 0;           ///< how long it will be watched; 0: until the button
  std::string sample = {};      ///< which one lies there; empty: the plain one
  double depth = 0, reach = 0;  ///< m
  double holds = 0;             ///< s, at least, of a palpation
};
/// of the readings while a sample is pressed or stroked
inline constexpr double kFeltRate_Hz = 1000;

/// What a station shows at one moment: a reading of the device or a picture.
struct RigMoment {
  double t = 0;                                   ///< s since the start, the program's clock
  std::optional<haptics::DeviceReading> reading;  ///< t_ns: the device's own clock
  std::optional<haptics::WrenchSample> wrench;    ///< with a reading, where there is a sensor
  /// takes it when called; stamped with the believed time of exposure
  std::function<std::optional<ar::Frame>()> picture;
  /// m, how far a lump in the sample has moved: by ultrasound, or seen in a clear sample
  std::optional<Vec3> lump_W = {};
};

inline constexpr std::uint32_t kMarkButton = 1;  ///< bit of DeviceReading::buttons that says "now"

/// A station that is being set up: what it shows, and somebody who does what is asked. Readings
/// come at about 100 Hz (kFeltRate_Hz while something is felt), pictures at the camera's rate, in
/// the order of the program's clock.
class Rig {
 public:
  virtual ~Rig() = default;
  virtual void ask(const Request& request) = 0;
  /// Nothing when the station has ended or the person gave up. Throws Error.
  virtual std::optional<RigMoment> next() = 0;
};

}  // namespace palpa::runtime
