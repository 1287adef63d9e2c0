#include "apps/training/engine.h"

#include <algorithm>
#include <array>

#include "anatomy/base/file_schema.h"

namespace palpa::training {
namespace {

constexpr char kSubclavianId[] = "paracentesis";

struct EngineNames {
  std::string name, command, before;
};

const std::array<EngineNames, 6> kNames{{{"needle", "subclavian", ""},
                                         {"palpation", "palpation", ""},
                                         {"squeeze", "squeeze", ""},
                                         {"search", "search", "surface"},
                                         {"friction", "friction", ""},
                                         {"pulse", "pulse", ""}}};

const EngineNames& namesOf(Engine engine) { return kNames[static_cast<std::size_t>(engine)]; }

}  // namespace

const std::string& nameOf(Engine engine) { return namesOf(engine).name; }

const std::string& commandOf(Engine engine) { return namesOf(engine).command; }

std::string taskWords(const std::string& id) {
  if (id == kSubclavianId) return "subclavian access";
  std::string words = id;
  std::replace(words.begin(), words.end(), '_', ' ');
  return words;
}

std::string taskIdOf(const std::string& named) {
  return named == commandOf(Engine::needle) ? kSubclavianId : named;
}

std::optional<Engine> engineNamed(std::string_view name) {
  for (std::size_t i = 0; i < kNames.size(); ++i)
    if (name == kNames[i].name || (!name.empty() && name == kNames[i].before))
      return static_cast<Engine>(i);
  return std::nullopt;
}

Engine engineIn(const JsonFile& file) {
  if (!file.has("engine")) refuseUnknownFields(file, "task");  // it may be there by another name
  const std::string name = file.text("engine");
  const std::optional<Engine> engine = engineNamed(name);
  if (!engine)
    file.refuse("engine",
                "is \"" + name + "\"; known: needle, palpation, squeeze, search, friction, pulse");
  return *engine;
}

void needEngine(const JsonFile& file, Engine engine) {
  if (engineIn(file) != engine)
    file.refuse("engine", "is \"" + file.text("engine") + "\"; here it must be " + nameOf(engine));
}

}  // namespace palpa::training
