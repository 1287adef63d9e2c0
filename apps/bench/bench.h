#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace palpa::bench {

struct AnatomyBenchOptions {
  bool quick = false;  ///< a smaller mesh and few queries, to try it out
};

/// Cost of the geometric questions: closest point on a mesh of 100 000 triangles beside VTK's and
/// Embree's, a needle and a tool's near misses against all organs of the reference patient, the
/// skin's deflection. One JSON object a line.
void benchAnatomy(const AnatomyBenchOptions& options);

struct CalibrationBenchOptions {
  int sets = 500;  ///< synthetic sets for each estimator
};

/// How near each estimator comes to what the data permit: rmse_over_crlb (root mean square error
/// over the Cramer-Rao bound; median over the parameters), coverage95 (share of truths inside the
/// stated 95 % intervals, all parameters), and the same with a tenth of gross errors. One JSON
/// object a line. Simulated data.
void benchCalibration(const CalibrationBenchOptions& options);

/// The floor of the shipped search task: making it, looking things up on it, the tick with every
/// augmentation beside the tick with none, and how soon and how calmly the tick tells that a part
/// of the task has begun. One JSON object a line. `quick`: a small height map and few repetitions.
/// Throws Error.
void benchFloor(bool quick);

struct HapticsBenchOptions {
  bool quick = false;  ///< two meshes, short strokes, a small height map, to try it out
  int most_triangles = 1'000'000;
};

/// Cost of the tick, fidelity of its force and smoothness at a refresh, over meshes of 1e3 to 1e6
/// triangles: one JSON object a line on standard output. Then the search task's floor
/// (benchFloor). The shape is known in closed form and stays with the judge; the tick sees the
/// meshes' snapshots only.
void benchHaptics(const HapticsBenchOptions& options);

struct LoopBenchOptions {
  double seconds = 20;  ///< of measurement, in 40 segments
  double rate_Hz = 1000;
  int cpu = -1;   ///< of the measured thread; -1: any
  int pages = 0;  ///< that look on through a console, in a second measurement
};

/// How late the haptic loop's ticks are, and how late a bare timer loop of the same priority is
/// with the same beside it, in turn in 10 blocks A B B A: one JSON object a line on standard
/// output. What the ratio of the two 99 % quantiles has above 1 is ours; the rest is the machine's.
/// With `pages` the same again while so many look on.
void benchLoop(const LoopBenchOptions& options);

struct ObjectBenchOptions {
  int seeds = 50;  ///< stations and hands for each object
};
/// How true the map of an object is that is learnt by touch (`palpa calibrate object`), against
/// what finite elements say of it. One JSON object a line. Simulated data. Throws Error.
void benchObject(const ObjectBenchOptions& options);
/// Of one learnt object; shares of the area, and of twenty places.
struct ObjectFigures {
  double within_10 = 0, friction_within_10 = 0;  ///< of the truth
  double covered = 0;                            ///< truths in their 95 % interval
  double touches = 0, seconds = 0;
  /// Pressed at the twenty places to be felt as one stiffness: rms of the force's error over rms of
  /// the wanted force, with the map, and with the one law that presses in the middle tell
  double rendered_off = 0, rendered_off_unmapped = 0;
};
std::vector<std::string> mappedObjects();
ObjectFigures objectFigures(const std::string& name, std::uint64_t seed);

struct MaterialBenchOptions {
  bool quick = false;  ///< without noise only, three of the mock-ups and two of the hands
};

/// How true haptic augmented reality is on simulated phantoms, whose forces come from finite
/// elements: one JSON object a line on standard output. Throws Error.
void benchMaterial(const MaterialBenchOptions& options);

struct RecordsBenchOptions {
  std::string records;                             ///< an empty database; empty: a file that passes
  std::vector<int> trials{1000, 10'000, 100'000};  ///< in hundreds: that of a trainee
};

/// Time and peak memory of a cohort's page and of an export over so many drawn (simulated) trials,
/// each in a process of its own. One JSON object a line. What was drawn stays in a database that
/// was given. Throws Error; UsageError for one that holds records.
void benchRecords(const RecordsBenchOptions& options);

struct RenderBenchOptions {
  int width = 1280, height = 720;
  bool quick = false;   ///< fewer blocks
  double minutes = 10;  ///< of frames in which something is saved or sorted now and then
};

/// What our frame costs beside VTK's own of the same things, how steady it is, and translucent
/// surfaces beside depth peeling. One JSON object a line. Throws Error where nothing can be drawn.
void benchRender(const RenderBenchOptions& options);

struct HeadsetBenchOptions {
  int frames = 1000;
};

/// What a frame for two eyes costs the processor, all threads, while the head moves as of somebody
/// at work: with everything but the drawing, which Mesa's drivers leave out when they are told to
/// (GALLIUM_NOOP). One JSON object. In a process that has drawn nothing yet.
void benchHeadset(const HeadsetBenchOptions& options);

struct ObserverBenchOptions {
  int poses = 200;  ///< before the puncture, and as many after it
};

/// What the AR view alone tells of a needle: the share of poses in which a program that gets only
/// pixels (`pictures/observer.h`) tells the tip's height above the skin within 3 mm, and its depth
/// behind it within 5 mm; the same without shadow and ring. One JSON object a line.
void benchObserver(const ObserverBenchOptions& options);

struct HudBenchOptions {
  int sessions = 200, first = 0;  ///< of a row without end, each always the same
};

/// Whether words cover what is worked with: recorded sessions of a needle, a palpation and a
/// search, of both sides and both hands, seen through the station's camera in windows from 320x240
/// to 3840x2160, with one eye, two and a headset. One JSON object a line. Simulated. Throws Error.
void benchHud(const HudBenchOptions& options);

struct RoomBenchOptions {
  int stations = 20;    ///< with the one whose session is measured; at least 2
  int blocks = 6;       ///< A B B A of sessions
  double seconds = 20;  ///< of each session
  std::string records;  ///< an empty database; empty: a file that passes
};

/// What a room of stations costs a session in real time: the 99 % quantile of its haptic tick's
/// lateness with broker, watcher and all other stations on the same computer, and without, in turn;
/// and whether every event that a station has recorded has arrived at the watcher once, in order,
/// although each station and the broker are killed once meanwhile. One JSON object a line. Needs
/// mosquitto. Trials stay in a database that was given. Throws Error; UsageError for one that holds
/// records.
void benchRoom(const RoomBenchOptions& options);

struct SessionBenchOptions {
  int trials = 4;
  std::uint64_t seed = 1;
  bool views = false;    ///< the scene is drawn where a trial is to be seen
  std::string tracking;  ///< images, model; empty: one after the other, with views images alone
};

/// What a paracentesis session of the simulated expert costs in virtual time, in the processor's
/// time of all its threads: seconds until its first tick with the patient built and with the
/// patient kept, how many times as fast as real time it runs from there, and which share of that
/// each stage takes; with the board tracked in pictures and by a model of them. One JSON object a
/// line. Throws Error, UsageError for the model with views.
void benchSession(const SessionBenchOptions& options);

struct StopBenchOptions {
  int presses = 200;  ///< from each source, with each part hung
};

/// Milliseconds from a press of the emergency stop to the first command of zero force, in real
/// time: 99 % quantile, median and largest, for every source of a stop and every part of a session
/// that may hang meanwhile. One JSON object a line, "stop.<source>.<hung part>". Throws Error.
void benchStop(const StopBenchOptions& options);

struct TrackingBenchOptions {
  double distance = 0.5;   ///< m, from camera to board
  double speed = 0.2;      ///< m/s, the peak of a hand's motion there and back
  double horizon_ms = 50;  ///< from an exposure to when its pose is drawn
  int width = 1280, height = 720;
  double rate_Hz = 30;
  bool quick = false;  ///< a tenth of the pictures
  std::uint64_t seed = 1;
};

/// How true, still and quick the tracker is, on pictures of the virtual camera (lens, blur, noise,
/// 5 ms of exposure in motion) whose truth is known. One JSON object a line; simulated data.
void benchTracking(const TrackingBenchOptions& options);

}  // namespace palpa::bench
