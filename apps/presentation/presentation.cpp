#include "apps/presentation/presentation.h"

#include <algorithm>
#include <array>
#include <utility>
#include <vector>

#include <nlohmann/json.hpp>

#include "anatomy/base/json_file.h"

namespace palpa::presentation {
namespace {

struct Part {
  const char *field, *words;
  bool Presentation::*shown;
};

constexpr std::array<Part, 9> kParts{{
    {"anatomy", "anatomy under the skin", &Presentation::anatomy},
    {"trail", "the tip's trail", &Presentation::trail},
    {"arrows", "force arrows", &Presentation::arrows},
    {"newtons", "newtons", &Presentation::newtons},
    {"tissue_words", "depth and tissue", &Presentation::tissue_words},
    {"contact_words", "what is touched", &Presentation::contact_words},
    {"guidance", "guidance", &Presentation::guidance},
    {"navigation", "a view that moves", &Presentation::navigation},
    {"skin_deflection", "skin that gives way", &Presentation::skin_deflection},
}};

template <class Look>
using Names = std::array<std::pair<const char*, Look>, 3>;

constexpr Names<SkinLook> kSkins{
    {{"solid", SkinLook::solid}, {"translucent", SkinLook::translucent}, {"free", SkinLook::free}}};
constexpr Names<FixedViews> kViews{
    {{"none", FixedViews::none}, {"one", FixedViews::one}, {"three", FixedViews::three}}};

template <class Look>
Look lookIn(const JsonFile& file, const char* field, const Names<Look>& names) {
  const std::string text = file.text(field);
  for (const auto& [name, look] : names)
    if (text == name) return look;
  file.refuse(field, "is \"" + text + "\"; it must be " + names[0].first + ", " + names[1].first +
                         " or " + names[2].first);
}

template <class Look>
const char* nameIn(const Names<Look>& names, Look look) {
  for (const auto& [name, value] : names)
    if (value == look) return name;
  return names[0].first;
}

/// A misspelt field would show what was to be hidden.
void refuseUnknown(const JsonFile& file) {
  std::vector<std::string> known{"$schema", "version", "name", "title", "source", "skin", "views"};
  for (const Part& part : kParts) known.emplace_back(part.field);
  for (const auto& [field, ignored] : file.json().items())
    if (std::find(known.begin(), known.end(), field) == known.end())
      file.refuse(field, "is no field of a presentation");
}

Presentation read(const JsonFile& file) {
  file.needVersion(1);
  refuseUnknown(file);
  Presentation shown;
  shown.name = file.text("name");
  shown.title = file.text("title");
  shown.source = file.text("source");
  shown.skin = lookIn(file, "skin", kSkins);
  shown.views = lookIn(file, "views", kViews);
  for (const Part& part : kParts) shown.*part.shown = file.flag(part.field);
  return shown;
}

}  // namespace

bool replacesFeeling(const Presentation& shown) {
  return shown.arrows || shown.newtons || shown.tissue_words || shown.contact_words;
}

bool unaided(const Presentation& shown) {
  return !replacesFeeling(shown) && shown.skin == SkinLook::solid && !shown.anatomy &&
         !shown.trail && !shown.guidance && !shown.skin_deflection;
}

Presentation withoutForces(Presentation shown) {
  shown.name += ", forces not shown";
  shown.arrows = shown.newtons = shown.tissue_words = shown.contact_words = false;
  return shown;
}

std::string describe(const Presentation& shown) {
  std::string words = shown.skin == SkinLook::solid         ? "solid skin"
                      : shown.skin == SkinLook::translucent ? "translucent skin"
                                                            : "skin as chosen";
  words += shown.views == FixedViews::none  ? ", no fixed view"
           : shown.views == FixedViews::one ? ", one fixed view at a time"
                                            : ", three fixed views";
  std::string hidden;
  for (const Part& part : kParts)
    if (!(shown.*part.shown)) hidden += (hidden.empty() ? "" : ", ") + std::string(part.words);
  return words + (hidden.empty() ? "; everything is shown" : "; not shown: " + hidden);
}

Presentation readPresentation(const std::filesystem::path& path) { return read(JsonFile(path)); }

std::string textOf(const Presentation& shown) {
  nlohmann::json text{{"version", 1},
                      {"name", shown.name},
                      {"title", shown.title},
                      {"source", shown.source},
                      {"skin", nameIn(kSkins, shown.skin)},
                      {"views", nameIn(kViews, shown.views)}};
  for (const Part& part : kParts) text[part.field] = shown.*part.shown;
  return text.dump();
}

Presentation presentationOf(const std::string& text, const std::string& where) {
  return read(JsonFile::ofText(text, where));
}

}  // namespace palpa::presentation
