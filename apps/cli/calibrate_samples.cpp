#include "apps/cli/calibrate_samples.h"

#include <cmath>

#include "anatomy/base/error.h"
#include "anatomy/base/nearest_word.h"
#include "apps/calibrate/collect.h"
#include "apps/calibrate/learnt_object.h"
#include "apps/calibrate/recorded.h"
#include "apps/calibrate/results.h"
#include "apps/cli/values.h"
#include "apps/station/assets.h"
#include "apps/twin/phantom/phantom_file.h"
#include "apps/twin/phantom/rough_surface.h"

namespace palpa::cli {

using namespace calibrate;
using station::CalibrationKind;

namespace {

Result fromCameraPictures(const CalibrateOptions& o, const station::Station& station,
                          const Origin& origin) {
  const std::unique_ptr<ar::Board> board =
      o.board.empty() ? ar::makeBoard(station.board, 1.0) : ar::makeBoard(o.board, 1.0);
  RecordedViews recorded = readViews(o.images, *board);
  if (recorded.views.size() < 4 && recorded.unseen.size() > recorded.views.size())
    throw Error("the board (" + board->describe() + ") was found in " +
                    std::to_string(recorded.views.size()) + " of " +
                    std::to_string(recorded.views.size() + recorded.unseen.size()) + " pictures",
                o.images, "Is it the board that --board names?");
  calibration::CameraModel camera;
  Result result =
      cameraResult(recorded.views, recorded.width, recorded.height, origin, &camera, o.all_corners);
  for (const std::string& name : recorded.unseen)
    result.advice.push_back("The board was not found in " + name + ".");
  return result;
}

ToolSamples toolSamples(const CalibrateOptions& o) {
  ToolSamples samples;
  if (o.pivot.empty())
    throw UsageError("is missing", "--pivot",
                     "Give the poses recorded while the tip rested in a hole");
  samples.pivot = readPoses(o.pivot);
  if (!o.spin.empty()) samples.spin = readPoses(o.spin);
  return samples;
}

/// The error is predicted where the station has its patient; without a station in the middle of
/// what was touched or seen.
Result fromTouchesAndPairs(const CalibrateOptions& o, const station::Station& station,
                           const Origin& origin) {
  std::vector<Touch> touches;
  TagSamples tag;
  std::vector<calibration::HandEyeSample>& pairs = tag.poses;
  if (!o.landmarks.empty()) touches = readTouches(o.landmarks);
  if (!o.pairs.empty()) pairs = readPosePairs(o.pairs);
  Vec3 middle = Vec3::Zero();
  for (const Touch& t : touches) middle += t.p_W / static_cast<double>(touches.size());
  if (touches.empty())
    for (const calibration::HandEyeSample& pair : pairs)
      middle += pair.X_CM.translation() / static_cast<double>(pairs.size());
  return registrationResult(touches, tag, o.station.empty() ? middle : station.entry_W, origin);
}

LumpSamples lumpSamples(const CalibrateOptions& o) {
  for (const auto& [name, file] : {std::pair("--without", &o.without),
                                   std::pair("--above", &o.above), std::pair("--check", &o.check)})
    if (file->empty())
      throw UsageError("is missing", name,
                       "An inclusion needs presses without the lump, above it, and at a place to "
                       "judge by; see --help");
  if (o.depth_mm <= 0)
    throw UsageError("is missing", "--depth-mm",
                     "Say how deep the middle of the lump lies below the top");
  LumpSamples samples;
  samples.without = readFelt(o.without);
  if (!o.strokes.empty()) samples.strokes = readFelt(o.strokes);
  samples.above = readFelt(o.above);
  if (!samples.above.samples.front().lump_P)
    throw Error("has no columns lump_x_mm, ...", o.above,
                "How far the lump moved must be recorded, too: by ultrasound, or by a camera "
                "through a clear sample");
  if (!o.beside.empty()) samples.beside.push_back(readFelt(o.beside));
  samples.check = readFelt(o.check);
  samples.depth = 1e-3 * o.depth_mm;
  return samples;
}

constexpr double kPressFor_s = 20, kStrokeFor_s = 25, kPressLumpFor_s = 6, kStrokeLumpFor_s = 12;

/// Where the simulated sample's lump lies: known to whoever cast it.
double lumpDepthOf(const station::Station& station, const std::string& mockup) {
  const twin::PhantomFile file = twin::readPhantoms(
      station::assetFile("phantoms/" + station.file.text("twin/samples") + ".json"));
  std::vector<std::string> known;
  for (const twin::Phantom& phantom : file.phantoms) {
    if (!phantom.block.lump) continue;
    if (phantom.name == mockup) return -phantom.block.lump->centre.z();
    known.push_back(phantom.name);
  }
  throw UsageError("is not a simulated sample with a lump" + didYouMean(mockup, known),
                   "\"" + mockup + "\"", "There are: " + listed(known, "and"));
}

/// Without the lump, above it, on four sides of it, stroking over it, and beside it once more to
/// judge by.
LumpSamples collectLump(const Scene& scene, const std::string& mockup) {
  constexpr double kBeside = 8e-3, kJudgedAt = 5e-3;  // m
  LumpSamples samples;
  samples.depth = lumpDepthOf(scene.station, mockup);
  samples.without = collectPresses(scene, "", {}, kPressLumpFor_s);
  samples.strokes = collectStrokes(scene, "", kStrokeLumpFor_s);
  samples.above = collectPresses(scene, mockup, {}, kPressLumpFor_s);
  for (const FeltPlace& place : {FeltPlace{kBeside, 0}, FeltPlace{0, kBeside},
                                 FeltPlace{-kBeside, 0}, FeltPlace{0, -kBeside}})
    samples.beside.push_back(collectPresses(scene, mockup, place, kPressLumpFor_s));
  samples.beside.push_back(collectStrokes(scene, mockup, kStrokeLumpFor_s));
  samples.check =
      collectPresses(scene, mockup, {kJudgedAt * 0.8, kJudgedAt * 0.6}, kPressLumpFor_s);
  return samples;
}

/// Where models are asked for, else the shipped rows.
calibration::TextureGrid gridOf(const CalibrateOptions& o) {
  calibration::TextureGrid grid;
  if (!o.forces_N.empty()) grid.forces = o.forces_N;
  if (!o.speeds_mm_per_s.empty()) grid.speeds = o.speeds_mm_per_s;
  if (!o.speeds_mm_per_s.empty())
    for (double& speed : grid.speeds) speed *= 1e-3;
  return grid;
}

TextureSamples textureSamples(const CalibrateOptions& o) {
  for (const auto& [name, file] :
       {std::pair("--strokes", &o.strokes), std::pair("--check", &o.check)})
    if (file->empty())
      throw UsageError("is missing", name,
                       "A texture needs strokes, and others to judge by; see --help");
  if (o.mass_g <= 0)
    throw UsageError("is missing", "--mass-g",
                     "Say how heavy the tool is with its accelerometer: weigh both");
  TextureSamples samples;
  samples.tool_mass = 1e-3 * o.mass_g;
  samples.grid = gridOf(o);
  double dt = 0;
  samples.strokes = readTextureStrokes(o.strokes, samples.tool_mass, &samples.dt);
  samples.check = readTextureStrokes(o.check, samples.tool_mass, &dt);
  if (dt != samples.dt)
    throw Error("is recorded at another rate than " + o.strokes, o.check, "Record both at 1 kHz");
  return samples;
}

const twin::RoughSurface& surfaceNamed(const twin::RoughBench& rough, const std::string& name) {
  std::vector<std::string> known;
  for (const twin::RoughSurface& surface : rough.surfaces) {
    if (surface.name == name) return surface;
    known.push_back(surface.name);
  }
  throw UsageError("is not a simulated surface" + didYouMean(name, known), "\"" + name + "\"",
                   "There are: " + listed(known, "and"));
}

calibration::TextureStroke rubbed(const twin::RoughBench& rough, const twin::RoughSurface& surface,
                                  const twin::RoughStroke& stroke) {
  const twin::RoughRecording recording = twin::strokeRough(surface, rough.tool, stroke);
  calibration::TextureStroke samples;
  for (std::size_t i = 0; i < recording.f_n.size(); ++i)
    samples.push_back(
        {recording.f_n[i], recording.speed[i], rough.tool.mass * recording.acceleration[i]});
  return samples;
}

/// At every node of the grid, and half way between neighbours to judge by.
TextureSamples collectTexture(const CalibrateOptions& o, Guide& guide) {
  constexpr double kRubFor_s = 20, kCheckFor_s = 30;
  const twin::RoughBench rough =
      twin::readRoughBench(station::assetFile("phantoms/textures/surfaces.json"));
  const twin::RoughSurface& surface = surfaceNamed(rough, o.surface);
  TextureSamples samples;
  samples.tool_mass = rough.tool.mass;
  samples.grid = gridOf(o);
  const std::vector<double>&forces = samples.grid.forces, &speeds = samples.grid.speeds;
  twin::RoughStroke stroke;
  stroke.seed = 1000 * o.seed;
  const int all = static_cast<int>(forces.size() * speeds.size());
  stroke.seconds = kRubFor_s;
  for (const double force : forces)
    for (const double speed : speeds) {
      ++stroke.seed;
      stroke.force = force;
      stroke.speed = speed;
      samples.strokes.push_back(rubbed(rough, surface, stroke));
      guide.progress("Strokes", static_cast<int>(samples.strokes.size()), all, surface.name);
    }
  stroke.seconds = kCheckFor_s;
  for (std::size_t f = 0; f + 1 < forces.size(); f += 2)
    for (std::size_t v = 0; v + 1 < speeds.size(); v += 3) {
      ++stroke.seed;
      stroke.force = std::sqrt(forces[f] * forces[f + 1]);
      stroke.speed = std::sqrt(speeds[v] * speeds[v + 1]);
      samples.check.push_back(rubbed(rough, surface, stroke));
    }
  if (samples.check.empty()) {  // one row or column: another stroke at its first node
    ++stroke.seed;
    stroke.force = forces.front();
    stroke.speed = speeds.front();
    samples.check.push_back(rubbed(rough, surface, stroke));
  }
  return samples;
}

}  // namespace

Result fromFiles(const CalibrateOptions& o, const station::Station& station, const Origin& origin) {
  if (o.kind == CalibrationKind::camera) return fromCameraPictures(o, station, origin);
  if (o.kind == CalibrationKind::tool)
    return toolResult(toolSamples(o), station.design.X_ET, origin);
  if (o.kind == CalibrationKind::workspace) return workspaceResult(readTouches(o.touches), origin);
  if (o.kind == CalibrationKind::registration) return fromTouchesAndPairs(o, station, origin);
  if (o.kind == CalibrationKind::latency) {
    if (o.camera_track.empty() || o.device_track.empty())
      throw UsageError("needs both", "--camera-track and --device-track",
                       "Give the same motion as both saw it");
    return latencyResult({readTrack(o.camera_track), readTrack(o.device_track)},
                         station.camera_latency_s, origin);
  }
  if (o.kind == CalibrationKind::material) return materialResult(readFelt(o.presses), origin);
  if (o.kind == CalibrationKind::friction) return frictionResult(readFelt(o.strokes), origin);
  if (o.kind == CalibrationKind::inclusion)
    return inclusionResult(
        lumpSamples(o),
        station.sample ? station.sample->tip_radius : station::SoftSample{}.tip_radius, origin);
  if (o.kind == CalibrationKind::object)
    return objectResult(touchesIn(readFelt(o.touches)), objectArea(), origin);
  if (o.kind == CalibrationKind::texture) return textureResult(textureSamples(o), origin);
  return forceSensorResult(readStaticReadings(o.readings),
                           Vec3(o.down[0], o.down[1], o.down[2]).normalized(), origin);
}

/// One routine on the bench: what it needs of the others is taken from the station.
Result onBench(const CalibrateOptions& o, const Scene& scene, const Origin& origin) {
  const station::Station& station = scene.station;
  if (o.kind == CalibrationKind::camera) {
    calibration::CameraModel camera;
    return cameraResult(collectViews(scene), station.camera.width, station.camera.height, origin,
                        &camera);
  }
  if (o.kind == CalibrationKind::tool)
    return toolResult(collectTool(scene), station.design.X_ET, origin);
  if (o.kind == CalibrationKind::workspace)
    return collectedWorkspace(scene, station.X_ET.translation(), origin);
  if (o.kind == CalibrationKind::registration)
    return collectedRegistration(
        scene, station.marker ? collectHeld(scene, station.camera) : std::vector<HeldPose>{},
        station.camera, station.X_ET.translation(), origin);
  if (o.kind == CalibrationKind::latency)
    return collectedLatency(scene, station.camera, markerOf(collectHeld(scene, station.camera)),
                            origin);
  if (o.kind == CalibrationKind::force_sensor)
    return forceSensorOf(scene, collectHeld(scene, station.camera), station.X_WD, origin);
  if (o.kind == CalibrationKind::material)
    return materialResult(collectPresses(scene, o.surface, {}, kPressFor_s), origin);
  if (o.kind == CalibrationKind::friction)
    return frictionResult(collectStrokes(scene, o.surface, kStrokeFor_s), origin);
  if (o.kind == CalibrationKind::inclusion)
    return inclusionResult(collectLump(scene, o.mockup), station.sample->tip_radius, origin);
  if (o.kind == CalibrationKind::object)
    return objectResult(collectObject(scene, o.mockup, objectArea()), objectArea(), origin);
  if (o.kind == CalibrationKind::texture)
    return textureResult(collectTexture(o, scene.guide), origin);
  throw UsageError("is not a calibration routine", "palpa calibrate " + o.name(),
                   "See palpa calibrate --help");
}

}  // namespace palpa::cli
