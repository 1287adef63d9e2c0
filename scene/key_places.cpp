#include "scene/key_places.h"

#include <algorithm>

#include "scene/scene_state.h"

namespace palpa::scene {
namespace {

constexpr KeyPlace kKeyPlaces[] = {
    {{"AE01"}, "1", '1'},     {{"AE02"}, "2", '2'},      {{"AE03"}, "3", '3'}, {{"AE04"}, "4", '4'},
    {{"AE05"}, "5", '5'},     {{"AE06"}, "6", '6'},      {{"AE07"}, "7", '7'}, {{"AE08"}, "8", '8'},
    {{"AE09"}, "9", '9'},     {{"AE10"}, "0", '0'},      {{"AD01"}, "q", 'Q'}, {{"AD02"}, "w", 'W'},
    {{"AD03"}, "e", 'E'},     {{"AD04"}, "r", 'R'},      {{"AD05"}, "t", 'T'}, {{"AD06"}, "y", 'Y'},
    {{"AD07"}, "u", 'U'},     {{"AD08"}, "i", 'I'},      {{"AD09"}, "o", 'O'}, {{"AD10"}, "p", 'P'},
    {{"AC01"}, "a", 'A'},     {{"AC02"}, "s", 'S'},      {{"AC03"}, "d", 'D'}, {{"AC04"}, "f", 'F'},
    {{"AC05"}, "g", 'G'},     {{"AC06"}, "h", 'H'},      {{"AC07"}, "j", 'J'}, {{"AC08"}, "k", 'K'},
    {{"AC09"}, "l", 'L'},     {{"AB01"}, "z", 'Z'},      {{"AB02"}, "x", 'X'}, {{"AB03"}, "c", 'C'},
    {{"AB04"}, "v", 'V'},     {{"AB05"}, "b", 'B'},      {{"AB06"}, "n", 'N'}, {{"AB07"}, "m", 'M'},
    {{"AB08"}, "comma", ','}, {{"AB09"}, "period", '.'},
};

std::string printOf(char us, const KeyPrints& prints) {
  if (const auto found = prints.find(us); found != prints.end()) return found->second;
  return us == ',' || us == '.' ? std::string("“") + us + "”" : std::string(1, us);
}

bool isNamed(char us) {
  return std::ranges::any_of(kKeyPlaces, [us](const KeyPlace& place) { return place.us == us; });
}

}  // namespace

std::span<const KeyPlace> keyPlaces() { return kKeyPlaces; }

const KeyPlace* keyPlaceOf(std::string_view xkb_name) {
  const auto* const found = std::ranges::find_if(
      kKeyPlaces, [xkb_name](const KeyPlace& place) { return xkb_name == place.xkb.data(); });
  return found == std::end(kKeyPlaces) ? nullptr : found;
}

std::string withKeys(const std::string& text, const KeyPrints& prints) {
  std::string shown;
  for (std::size_t i = 0; i < text.size(); ++i) {
    const bool key =
        text[i] == '[' && i + 2 < text.size() && text[i + 2] == ']' && isNamed(text[i + 1]);
    shown += key ? printOf(text[i + 1], prints) : std::string(1, text[i]);
    if (key) i += 2;
  }
  return shown;
}

Hud withKeys(const Hud& hud, const KeyPrints& prints) {
  Hud shown = hud;
  for (std::string Hud::*words : {&Hud::phase, &Hud::notice, &Hud::note, &Hud::can_do})
    shown.*words = withKeys(hud.*words, prints);
  return shown;
}

}  // namespace palpa::scene
