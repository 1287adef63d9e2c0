#include "apps/training/engine.h"
#include "anatomy/base/file_schema.h"

#include <array>

namespace palpa::training {
namespace {

struct EngineNames {
  std::string name, command, before;
};

const std::array<EngineNames, 6> kNames{{{"needle", "paracentesis", ""},
                                         {"palpation", "palpation", ""},
                                         {"squeeze", "squeeze", ""},
                                         {"search", "search", "surface"},
                                         {"friction", "friction", ""},
                                         {"pulse", "pulse", ""}}};

const EngineNames& namesOf(Engine engine) { return kNames[static_cast<std::size_t>(engine)]; }

}  // namespace

const std::string& nameOf(Engine engine) { return namesOf(engine).name; }

const std::string& commandOf(Engine engine) { return namesOf(engine).command; }

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
