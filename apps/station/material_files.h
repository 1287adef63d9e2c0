#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "anatomy/base/json_file.h"
#include "apps/station/calibrations.h"
#include "apps/station/object_map_file.h"
#include "haptics/contact/needle_materials.h"
#include "haptics/modulation/touch_augmentation.h"

namespace palpa::station {

/// What the needle feels, with the spread of the skin's strength over trials.
struct NeedleFile {
  haptics::NeedleMaterials materials;
  double puncture_low_N = 1.0, puncture_high_N = 2.5;  ///< uniform between the two, per trial
};

/// assets/materials/needle.json: every figure with unit, source and range. Throws UsageError.
NeedleFile readNeedleFile(const std::filesystem::path& file);

/// A lump that can be put into a sample, as it was identified (`palpa calibrate inclusion`) and as
/// whoever cast it describes it.
struct LumpKind {
  std::string name;
  haptics::VirtualInclusion law;
  double depth = 0, diameter = 0;  ///< m, of its middle below the top; its own
  int hardness = 0, mobility = 0;  ///< 1 soft, 2 hard; 1 fixed, 2 mobile
  double contrast = 0;  ///< what it adds beside and above it, rms, over the force: 0.24 is 24 %
};

/// What a sample is made of, and the lumps that were identified in its like, all felt with one
/// round tip.
struct LumpLibrary {
  haptics::HuntCrossley surface;
  double x0 = 0;  ///< m
  haptics::Dahl friction;
  haptics::TextureLaw texture;  ///< that is added to the surface; no speeds: none
  double tip_radius = 0;        ///< m
  bool simulated = false;       ///< identified on the virtual bench
  /// By what the surface is known: "the library of lumps", "this station's calibration of
  /// 2026-11-02"
  std::string of_surface;
  std::optional<MappedObject>
      map;  ///< what it is like from place to place; none: the same all over
  std::vector<LumpKind> kinds;
};

/// Throws UsageError or Error naming file and field: no kinds or more than eight, a law with k < 0,
/// b < 0 or m outside 1 to 2 (0.5 to 3 for a lump's bed), a calibration that failed, one of another
/// kind.
LumpLibrary readLumps(const std::filesystem::path& file);

/// The same with the surface as this station's own "material" and "friction" calibrations found it,
/// where it has them: the sample that lies there is touched, not the library's. Throws as
/// `readLumps` for a law that cannot be; whether a calibration passed, the station's verdict says.
LumpLibrary onStation(LumpLibrary library, const std::vector<AppliedCalibration>& calibrations);

/// The same with the surface of that name in a file of surfaces (assets/materials/surfaces.json),
/// as it was identified there; unchanged where the file holds no such name. Throws as `readLumps`.
LumpLibrary withSurface(LumpLibrary library, const std::filesystem::path& file,
                        const std::string& name);
std::vector<std::string> surfacesIn(const std::filesystem::path& file);  ///< their names

/// A texture as `palpa calibrate texture` left it, without a bound. Throws Error for a calibration
/// that failed, one of another kind, and figures that no texture has.
haptics::TextureLaw readTexture(const std::filesystem::path& file);

/// Bounded for a limiter of this slew (haptics::largestTexture). Throws UsageError for a loop that
/// does not run at 1 kHz, and for a texture three times whose rms, at some force and speed, is
/// above the bound. Without a texture nothing is asked.
haptics::TextureLaw bounded(haptics::TextureLaw texture, double slew_N_per_s, double rate_Hz);

/// What the loop has to know of the library.
haptics::TouchAugmentation touchOf(const LumpLibrary& library);

}  // namespace palpa::station
