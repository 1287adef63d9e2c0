#pragma once

#include <filesystem>
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

/// Arrows, newtons or words say what the hand should feel.
bool replacesFeeling(const Presentation& shown);

/// Nothing that is not there without a simulator: fit for an assessment.
bool unaided(const Presentation& shown);

/// Practice, but nothing that replaces feeling.
Presentation withoutForces(Presentation shown);

/// "solid skin, one fixed view at a time; not shown: anatomy under the skin, trail, ..."
std::string describe(const Presentation& shown);

/// Of assets/presentations. Throws UsageError naming file and field.
Presentation readPresentation(const std::filesystem::path& file);

/// The file's text, for the evidence.
std::string textOf(const Presentation& shown);
/// The reverse; what old evidence does not say is the default.
Presentation presentationOf(const std::string& text, const std::string& where);

}  // namespace palpa::presentation
