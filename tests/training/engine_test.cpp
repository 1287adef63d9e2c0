#include "apps/training/engine.h"

#include <gtest/gtest.h>

#include "anatomy/base/error.h"

namespace palpa::training {
namespace {

TEST(Engine, NamesRoundTripAndTheOldNameIsRead) {
  for (const Engine engine : {Engine::needle, Engine::palpation, Engine::squeeze, Engine::search,
                              Engine::friction, Engine::pulse})
    EXPECT_EQ(engineNamed(nameOf(engine)), engine);
  EXPECT_EQ(engineNamed("surface"), Engine::search);
  EXPECT_FALSE(engineNamed(""));
  EXPECT_FALSE(engineNamed("Needle"));
}

TEST(Engine, AWrongOneIsRefusedInWords) {
  const auto task = [](const char* engine) {
    return JsonFile(nlohmann::json::object({{"engine", engine}}), "a task");
  };
  EXPECT_EQ(engineIn(task("surface")), Engine::search);
  EXPECT_NO_THROW(needEngine(task("search"), Engine::search));
  EXPECT_THROW(needEngine(task("search"), Engine::needle), UsageError);
  EXPECT_THROW(engineIn(task("drill")), UsageError);
}

}  // namespace
}  // namespace palpa::training
