#pragma once

#include <filesystem>
#include <nlohmann/json_fwd.hpp>
#include <string>

namespace palpa::presentation {

/// free: translucent at first, and a key changes it.
enum class SkinLook { solid, translucent, free };
/// Beside the picture: none; one of front, side and top, which a key changes; all three.
enum class FixedViews { none, one, three };

/// What may be seen and read in a trial, each alone. What is felt is no part of it.
struct Presentation {
  std::string name = "practice", title, source;
  SkinLook skin = SkinLook::free;
  FixedViews views = FixedViews::three;
  bool anatomy = true;          ///< what lies under the skin, in the picture and in the fixed views
  bool trail = true;            ///< the tip's way
  bool arrows = true;           ///< forces as arrows, with their legend
  bool newtons = true;          ///< forces as numbers
  bool tissue_words = true;     ///< how deep, and in what
  bool contact_words = true;    ///< what is touched; warnings of an injury
  bool guidance = true;         ///< lines, rings, maps and steps that lead; given only if asked for
  bool navigation = true;       ///< the view may be turned and moved
  bool skin_deflection = true;  ///< the skin may be shown to give way

  bool operator==(const Presentation&) const = default;
};

/// Arrows, newtons, words or a skin that gives way say what the hand should feel.
bool replacesFeeling(const Presentation& shown);

/// Nothing that is not there without a simulator: fit for an assessment.
bool unaided(const Presentation& shown);

/// The same with nothing that replaces feeling, and no guidance: maps of pressure and steps tell
/// it.
Presentation withoutForces(Presentation shown);

/// "solid skin, one fixed view at a time; not shown: anatomy under the skin, trail, ..."
std::string describe(const Presentation& shown);

/// Throws UsageError naming file and field.
Presentation readPresentation(const std::filesystem::path& file);

/// By the name of a set in the folder `shipped`, else a file, relative to `beside`. Throws
/// UsageError naming `where` it was asked for, and the sets that there are.
Presentation presentationNamed(const std::string& text, const std::filesystem::path& shipped,
                               const std::filesystem::path& beside, const std::string& where);

/// As in a file, for the evidence.
nlohmann::json jsonOf(const Presentation& shown);

}  // namespace palpa::presentation
