#include <gtest/gtest.h>

#include "apps/session/session_facts.h"

/// What a report says of how the session was drawn.
namespace palpa::session {
namespace {

SessionRun drawnBy(const std::string& renderer) {
  SessionRun run;
  run.renderer = renderer;
  runtime::Lateness scene;
  scene.name = "scene";
  scene.steps = 900;
  scene.cost = {31'000, 46'000, 60'000, 88'000};
  run.lateness.push_back(scene);
  return run;
}

TEST(PictureFacts, SayHowSteadilyItDrewAndByWhat) {
  const std::vector<report::Fact> card = runNotes(drawnBy("NVIDIA RTX 4000/PCIe"));
  ASSERT_EQ(card.size(), 1u);
  EXPECT_EQ(card[0].value, "900; one takes 31 ms (median), 99 % below 46 ms, the longest 88 ms");
  EXPECT_EQ(card[0].remark, "on NVIDIA RTX 4000/PCIe");
  const std::vector<report::Fact> processor = runNotes(drawnBy("llvmpipe (LLVM 15.0.6)"));
  ASSERT_EQ(processor.size(), 1u);
  EXPECT_EQ(processor[0].remark, "on the processor, no graphics card: llvmpipe (LLVM 15.0.6)");
  EXPECT_TRUE(runNotes(drawnBy("")).empty()) << "nothing was drawn";
}

}  // namespace
}  // namespace palpa::session
