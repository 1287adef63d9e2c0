#include "layers.h"

namespace palpa::house {
namespace {

using Names = std::vector<std::string>;
using Layers = std::vector<Layer>;

const Names kLibraries{"anatomy", "haptics", "calibration", "ar", "scene"};

Names librariesAnd(Names more) {
  more.insert(more.end(), kLibraries.begin(), kLibraries.end());
  return more;
}

Layers anatomyLayers() {
  return {
      {.folder = "anatomy/base", .libraries = {"JSON", "OpenSSL", "Boost"}, .sealed = true},
      {.folder = "anatomy/geometry", .libraries = {"Eigen"}, .sealed = true},
      {.folder = "anatomy/deflection",
       .ours = {"anatomy/geometry"},
       .libraries = {"Eigen"},
       .sealed = true},
      {.folder = "anatomy",
       .never = {"anatomy/import", "anatomy/volume"},
       .libraries = {"Eigen", "JSON", "tinygltf"},
       .sealed = true},
      {.folder = "anatomy/import",
       .ours = {"anatomy"},
       .never = {"anatomy/volume"},
       .libraries = {"Eigen", "JSON", "tinygltf", "VTK data"},
       .sealed = true},
      {.folder = "anatomy/volume",
       .ours = {"anatomy"},
       .never = {"anatomy/import"},
       .libraries = {"Eigen", "JSON", "GDCM", "VTK data", "zlib"},
       .sealed = true},
  };
}

Layers hapticsLayers() {
  return {
      {.folder = "haptics/materials",
       .ours = {"anatomy/geometry"},
       .libraries = {"Eigen"},
       .sealed = true},
      {.folder = "haptics/surface",
       .ours = {"anatomy/geometry"},
       .libraries = {"Eigen"},
       .sealed = true},
      {.folder = "haptics/augmentation",
       .ours = {"anatomy/geometry", "haptics/surface"},
       .libraries = {"Eigen"},
       .sealed = true},
      // The tick: contact, modulation, safety, loop and what they share. It reads no files.
      {.folder = "haptics",
       .ours = {"anatomy/geometry"},
       .never = {"haptics/devices", "haptics/sensors"},
       .libraries = {"Eigen"},
       .sealed = true},
      {.folder = "haptics/sensors",
       .ours = {"haptics", "anatomy/geometry"},
       .never = {"haptics/devices"},
       .libraries = {"Eigen"},
       .sealed = true},
      {.folder = "haptics/devices",
       .ours = {"haptics", "anatomy/geometry"},
       .never = {"haptics/sensors"},
       .libraries = {"Eigen", "libusb"},
       .sealed = true},
  };
}

Layers visionAndSceneLayers() {
  return {
      {.folder = "calibration",
       .ours = {"anatomy/geometry", "haptics/materials"},
       .libraries = {"Eigen", "Ceres", "Boost", "OpenCV", "JSON"},
       .sealed = true},
      {.folder = "ar",
       .ours = {"anatomy/geometry", "calibration", "ar/codecs"},
       .never = {"ar/headset"},
       .libraries = {"Eigen", "OpenCV", "AprilTag", "JSON"},
       .sealed = true},
      {.folder = "ar/codecs", .libraries = {"OpenCV"}, .sealed = true},
      {.folder = "ar/headset",
       .ours = {"anatomy/geometry"},
       .libraries = {"Eigen", "OpenXR", "GLM", "OpenGL"},
       .sealed = true},
      {.folder = "scene",
       .ours = {"anatomy"},
       .never = {"anatomy/import", "anatomy/volume"},
       .libraries = {"Eigen", "VTK", "VTK data", "OpenGL"},
       .sealed = true},
  };
}

/// What the program stands on: the system, time and threads, files, records.
Layers platformLayers() {
  return {
      {.folder = "apps/os", .sealed = true},
      {.folder = "apps/os/tls", .ours = {"apps/os"}, .libraries = {"OpenSSL"}, .sealed = true},
      {.folder = "apps/language", .libraries = {"JSON"}, .sealed = true},
      {.folder = "apps/training", .libraries = {"JSON"}, .sealed = true},
      {.folder = "apps/presentation", .libraries = {"JSON"}, .sealed = true},
      {.folder = "apps/runtime",
       .ours = {"anatomy", "haptics", "calibration", "ar", "apps/os"},
       .never = {"apps/twin"},
       .libraries = {"Eigen", "OpenCV", "JSON"}},
      {.folder = "apps/headset",
       .ours = {"anatomy/geometry", "ar/headset", "scene", "apps/runtime"},
       .never = {"apps/twin"},
       .libraries = {"Eigen"}},
      {.folder = "apps/sound",
       .ours = {"scene", "apps/os", "apps/runtime", "apps/trial"},
       .never = {"apps/twin"},
       .libraries = {"OpenAL"}},
      {.folder = "apps/station",
       .ours = {"anatomy", "haptics", "calibration", "ar"},
       .never = {"apps/twin"},
       .libraries = {"Eigen", "OpenCV", "JSON"}},
      {.folder = "apps/record",
       .ours = {"anatomy/geometry", "haptics", "apps/os", "apps/training", "apps/runtime"},
       .never = {"apps/record/store", "apps/twin"},
       .libraries = {"Eigen", "JSON", "SQLite", "zlib"}},
      {.folder = "apps/record/store",
       .ours = {"apps/os", "apps/record", "apps/runtime", "apps/station"},
       .never = {"apps/twin"},
       .libraries = {"Eigen", "JSON", "SQLite", "PostgreSQL"}},
      {.folder = "apps/link",
       .ours = {"apps/os", "apps/training", "apps/record", "apps/assess/metrics", "apps/runtime",
                "apps/station"},
       .never = {"apps/link/igtl", "apps/twin"},
       .libraries = {"JSON", "httplib", "OpenSSL"}},
      {.folder = "apps/link/igtl",
       .ours = {"anatomy/geometry", "haptics", "ar", "apps/os", "apps/runtime"},
       .never = {"apps/twin"},
       .libraries = {"Eigen", "JSON", "OpenIGTLink"}},
      {.folder = "apps/learning",
       .ours = {"apps/os", "apps/link", "apps/runtime"},
       .never = {"apps/link/igtl", "apps/twin"},
       .libraries = {"JSON", "OpenSSL", "zlib", "cjose"}},
      {.folder = "apps/room",
       .ours = {"apps/os", "apps/runtime"},
       .never = {"apps/twin"},
       .libraries = {"JSON", "OpenSSL", "Mosquitto", "Avahi"}},
      {.folder = "apps/live",
       .ours = {"anatomy/geometry", "haptics", "ar/codecs", "scene", "apps/os", "apps/training",
                "apps/runtime", "apps/trial"},
       .never = {"haptics/devices", "apps/twin"},
       .libraries = {"OpenCV", "JSON"}},
  };
}

/// Scores, studies and pages: from plain values, whoever made them.
Layers judgementLayers() {
  return {
      {.folder = "apps/assess/metrics",
       .ours = {"anatomy/geometry"},
       .libraries = {"Eigen"},
       .sealed = true},
      {.folder = "apps/assess/statistics", .libraries = {"Eigen", "Boost"}, .sealed = true},
      {.folder = "apps/assess/competence",
       .ours = {"apps/training", "apps/assess/metrics", "apps/assess/statistics"},
       .libraries = {"Eigen", "JSON", "Boost"},
       .sealed = true},
      {.folder = "apps/assess",
       .ours = {"anatomy", "haptics", "calibration", "apps/training"},
       .never = {"anatomy/import", "anatomy/volume", "haptics/devices", "haptics/sensors"},
       .libraries = {"Eigen", "JSON", "Boost"},
       .sealed = true},
      {.folder = "apps/study",
       .ours = {"apps/training", "apps/presentation", "apps/record/store", "apps/runtime",
                "apps/station"},
       .never = {"apps/study/run", "apps/study/analysis", "apps/twin"},
       .libraries = {"Eigen", "JSON"}},
      {.folder = "apps/study/analysis",
       .ours = {"apps/training", "apps/assess/metrics", "apps/assess/statistics"},
       .libraries = {"Eigen", "JSON", "Boost"},
       .sealed = true},
      {.folder = "apps/report",
       .ours = {"anatomy/geometry", "haptics", "ar/boards", "apps/language", "apps/training",
                "apps/assess", "apps/study/analysis"},
       .never = {"apps/record", "apps/twin", "apps/task_*"},
       .libraries = {"Eigen", "JSON", "Cairo", "WebP"}},
  };
}

/// Trials: what is trained, shown, simulated, recorded and judged again.
Layers trialLayers() {
  return {
      {.folder = "apps/trial",
       .ours = librariesAnd({"apps/training", "apps/presentation", "apps/runtime", "apps/station"}),
       .never = {"apps/twin"},
       .libraries = {"Eigen", "OpenCV", "JSON"}},
      {.folder = "apps/task_*",
       .ours = librariesAnd({"apps/training", "apps/presentation", "apps/trial", "apps/runtime",
                             "apps/assess", "apps/station"}),
       .never = {"apps/record", "apps/report", "apps/twin"},
       .libraries = {"Eigen", "OpenCV", "JSON"}},
      {.folder = "apps/replay",
       .ours = librariesAnd(
           {"apps/training", "apps/task_*", "apps/trial", "apps/assess", "apps/runtime"}),
       .never = {"apps/record", "apps/report", "apps/twin"},
       .libraries = {"Eigen", "OpenCV", "JSON"}},
      {.folder = "apps/evidence",
       .ours =
           librariesAnd({"apps/training", "apps/record", "apps/runtime", "apps/station",
                         "apps/trial", "apps/task_*", "apps/assess", "apps/replay", "apps/report"}),
       .never = {"apps/session", "apps/twin"},
       .libraries = {"Eigen", "JSON"}},
      // What is simulated is not what renders it: the twin knows none of the laws of the tick.
      {.folder = "apps/twin",
       .ours = {"anatomy", "haptics/device.h", "haptics/sensors", "calibration", "ar",
                "apps/runtime", "apps/station"},
       .libraries = {"Eigen", "OpenCV", "JSON"}},
      {.folder = "apps/twin/phantom",
       .ours = {"anatomy/geometry"},
       .libraries = {"Eigen", "JSON"},
       .sealed = true},
      {.folder = "apps/session",
       .ours = librariesAnd({"apps"}),
       .never = {"apps/bench", "apps/calibrate", "apps/cli", "apps/console", "apps/doctor",
                 "apps/study"},
       .libraries = {"Eigen", "OpenCV", "JSON"}},
      {.folder = "apps/study/run",
       .ours = {"anatomy", "calibration", "apps/os", "apps/training", "apps/study", "apps/session",
                "apps/evidence", "apps/record", "apps/station", "apps/runtime", "apps/assess",
                "apps/task_*"},
       .never = {"apps/cli"},
       .libraries = {"Eigen", "JSON"}},
  };
}

/// What a person starts.
Layers programLayers() {
  return {
      {.folder = "apps/calibrate",
       .ours = librariesAnd({"apps/record", "apps/report", "apps/runtime", "apps/station"}),
       .never = {"apps/twin"},
       .libraries = {"Eigen", "OpenCV", "JSON"}},
      {.folder = "apps/doctor",
       .ours = librariesAnd({"apps/os", "apps/station", "apps/runtime", "apps/record/store",
                             "apps/link/igtl", "apps/sound"}),
       .never = {"apps/twin"},
       .libraries = {"Eigen", "OpenCV", "JSON"}},
      {.folder = "apps/console",
       .ours = {"anatomy/geometry", "apps/os", "apps/language", "apps/training", "apps/runtime",
                "apps/live", "apps/room", "apps/record", "apps/link", "apps/learning", "apps/study",
                "apps/station"},
       .never = {"apps/link/igtl", "apps/study/run", "apps/study/analysis", "apps/session",
                 "apps/twin"},
       .libraries = {"JSON", "httplib", "OpenSSL"}},
      {.folder = "apps/bench",
       .ours = librariesAnd({"apps"}),
       .never = {"apps/cli"},
       .libraries = {"Eigen", "OpenCV", "JSON", "VTK", "VTK data", "Embree"}},
      {.folder = "apps/cli",
       .ours = librariesAnd({"apps"}),
       .libraries = {"Eigen", "OpenCV", "JSON", "CLI11"}},
  };
}

Layers makeLayers() {
  Layers all;
  for (const Layers& some : {anatomyLayers(), hapticsLayers(), visionAndSceneLayers(),
                             platformLayers(), judgementLayers(), trialLayers(), programLayers()})
    all.insert(all.end(), some.begin(), some.end());
  return all;
}

}  // namespace

const std::vector<Layer>& layers() {
  static const Layers all = makeLayers();
  return all;
}

}  // namespace palpa::house
