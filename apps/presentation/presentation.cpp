#include "apps/presentation/presentation.h"

#include <algorithm>
#include <array>
#include <set>
#include <utility>
#include <vector>

#include <nlohmann/json.hpp>

#include "anatomy/base/error.h"
#include "anatomy/base/file_schema.h"
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

}  // namespace

bool replacesFeeling(const Presentation& shown) {
  return shown.arrows || shown.newtons || shown.tissue_words || shown.contact_words ||
         shown.skin_deflection;
}

bool unaided(const Presentation& shown) {
  return !replacesFeeling(shown) && shown.skin == SkinLook::solid && !shown.anatomy &&
         !shown.trail && !shown.guidance && !shown.navigation;
}

Presentation withoutForces(Presentation shown) {
  shown.name += ", forces not shown";
  shown.arrows = shown.newtons = shown.tissue_words = shown.contact_words = false;
  shown.skin_deflection = shown.guidance = false;  // a map of pressures is one, too
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
  return words + (hidden.empty() ? "; everything may be shown" : "; not shown: " + hidden);
}

Presentation readPresentation(const std::filesystem::path& path) {
  const JsonFile file(path);
  needKind(file, "presentation", 1);
  Presentation shown;
  shown.name = file.text("name");
  shown.title = file.text("title");
  shown.source = file.text("source");
  shown.skin = lookIn(file, "skin", kSkins);
  shown.views = lookIn(file, "views", kViews);
  for (const Part& part : kParts) shown.*part.shown = file.flag(part.field);
  return shown;
}

Presentation presentationNamed(const std::string& text, const std::filesystem::path& shipped,
                               const std::filesystem::path& beside, const std::string& where) {
  std::set<std::string> names;
  for (const auto& entry : std::filesystem::directory_iterator(shipped))
    names.insert(entry.path().stem().string());
  if (names.count(text)) return readPresentation(shipped / (text + ".json"));
  if (std::filesystem::is_regular_file(beside / text)) return readPresentation(beside / text);
  std::string all;
  for (const std::string& name : names) all += (all.empty() ? "" : ", ") + name;
  throw UsageError("is \"" + text + "\", which is no presentation and no file", where,
                   "Give one of " + all + ", or a file like those in assets/presentations");
}

nlohmann::json jsonOf(const Presentation& shown) {
  nlohmann::json json{{"version", 1},
                      {"name", shown.name},
                      {"title", shown.title},
                      {"source", shown.source},
                      {"skin", nameIn(kSkins, shown.skin)},
                      {"views", nameIn(kViews, shown.views)}};
  for (const Part& part : kParts) json[part.field] = shown.*part.shown;
  return json;
}

}  // namespace palpa::presentation
