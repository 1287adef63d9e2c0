#pragma once

#include <array>
#include <map>
#include <span>
#include <string>
#include <string_view>

namespace palpa::scene {

struct Hud;

/// A key that is known by where it lies, whatever the layout makes of it: letters, digits, comma
/// and full stop of the US layout.
struct KeyPlace {
  std::array<char, 5> xkb;  ///< the place's name in XKB: "AD05"
  const char* name;         ///< what it is called here: "t", "1", "comma"
  char us;                  ///< as texts name it: 'T', '1', ','
};
std::span<const KeyPlace> keyPlaces();
const KeyPlace* keyPlaceOf(std::string_view xkb_name);  ///< null: known by what it types

/// What a layout prints on the places whose letter is another one than on a US keyboard.
using KeyPrints = std::map<char, std::string>;

/// A text names a key as "[A] ends the trial", by its US letter; a person sees what the keyboard
/// prints there: "Q ends the trial" on a French one. Signs stand in quotation marks.
std::string withKeys(const std::string& text, const KeyPrints& prints);
Hud withKeys(const Hud& hud, const KeyPrints& prints);

}  // namespace palpa::scene
