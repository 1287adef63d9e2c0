#include "apps/console/jobs.h"

#include <gtest/gtest.h>

#include <atomic>
#include <fstream>
#include <memory>

#include "anatomy/base/error.h"
#include "apps/runtime/clock.h"
#include "tests/support/damage.h"
#include "tests/support/scratch_folder.h"

namespace palpa::console {
namespace {

struct Workshop {
  explicit Workshop(const std::string& name) : folder(name) {
    place.home = folder.path();
    jobs = std::make_unique<Jobs>(place);
  }
  std::string settled(const std::string& id) const {
    const auto until = runtime::ServingClock::now() + std::chrono::seconds(60);
    while (jobs->one(id)["state"] == "working" && runtime::ServingClock::now() < until)
      runtime::rest(std::chrono::milliseconds(5));
    return jobs->one(id)["state"];
  }
  bool says(const std::string& id, const std::string& line) const {
    const auto until = runtime::ServingClock::now() + std::chrono::seconds(60);
    while (jobs->one(id)["lines"] != nlohmann::json{line} && runtime::ServingClock::now() < until)
      runtime::rest(std::chrono::milliseconds(5));
    return jobs->one(id)["lines"] == nlohmann::json{line};
  }
  const test::ScratchFolder folder;
  ConsolePlace place;
  std::unique_ptr<Jobs> jobs;
};

JobRequest report(const std::string& key) {
  return {key, "Report", {"report", "trainee", "--out", "{}/report"}, "report/trainee.html", {}};
}
JobRequest waiting(const std::string& key) { return {key, "Long", {"wait"}, "", {}}; }

TEST(Jobs, APageIsMadeAndHandedOut) {
  const Workshop w("jobs-page");
  bool good = false;
  JobRequest request = report("a");
  request.then = [&](const std::filesystem::path&, bool came) { good = came; };
  const std::string id = w.jobs->add(std::move(request));
  EXPECT_TRUE(isId(id));
  EXPECT_EQ(w.settled(id), "done");
  EXPECT_TRUE(good);
  EXPECT_EQ(w.jobs->one(id)["page"], "/api/pages/" + id);
  EXPECT_TRUE(std::filesystem::exists(w.jobs->page(id)));
}

TEST(Jobs, WhatFailsSaysWhy) {
  const Workshop w("jobs-fail");
  const std::string id = w.jobs->add({"a", "Nothing", {"nonsense"}, "", {}}),
                    pageless = w.jobs->add({"b", "No page", {"facts"}, "report/none.html", {}});
  EXPECT_EQ(w.settled(id), "failed");
  EXPECT_EQ(w.jobs->one(id)["message"], "nonsense: is played by nobody. Ask for something else");
  EXPECT_EQ(w.settled(pageless), "failed");
  EXPECT_EQ(w.jobs->one(pageless)["page"], "");
}

/// A page that asks again and again is told how it is; a failure is told, not hidden by another
/// try, and the next who asks begins anew.
TEST(Jobs, WhatIsAskedForIsBegunOnceAndItsFailureToldOnce) {
  const Workshop w("jobs-ask");
  const auto settled = [&](const JobRequest& request) {
    std::string id = w.jobs->ask(request)["id"];
    EXPECT_TRUE(w.settled(id) == "done" || w.settled(id) == "failed");
    return id;
  };
  const std::string page = settled(report("a"));
  EXPECT_EQ(w.jobs->ask(report("a"))["id"], page);  // done long ago: not made again
  EXPECT_EQ(w.jobs->ask(report("a"))["state"], "done");
  std::filesystem::remove_all(w.place.jobs() / page);  // with somebody who was deleted
  EXPECT_EQ(w.jobs->ask(report("a"))["state"], "working");
  EXPECT_NE(settled(report("a")), page) << "made anew";
  const JobRequest bad{"b", "Nothing", {"nonsense"}, "", {}};
  const std::string failed = settled(bad);
  const nlohmann::json told = w.jobs->ask(bad);
  EXPECT_EQ(told["id"], failed);
  EXPECT_EQ(told["state"], "failed");
  EXPECT_NE(w.jobs->ask(bad)["id"], failed);
}

TEST(Jobs, TheSameWorkIsDoneOnceAtATime) {
  const Workshop w("jobs-same");
  const std::string first = w.jobs->add(waiting("a"));
  EXPECT_EQ(w.jobs->add(waiting("a")), first);
  const std::string second = w.jobs->add(report("b"));
  EXPECT_NE(second, first);
  EXPECT_EQ(w.jobs->workingOn("a"), first);
  EXPECT_EQ(w.jobs->workingOn("c"), "");
  EXPECT_TRUE(w.says(first, "3 of 20"));
  EXPECT_NEAR(w.jobs->one(first)["done"].get<double>(), 0.15, 1e-12);
  EXPECT_EQ(w.jobs->one(second)["state"], "working") << "waits: one after the other";
  w.jobs->stop(first);
  EXPECT_EQ(w.settled(first), "failed");
  EXPECT_EQ(w.jobs->one(first)["message"], "It was stopped.");
  EXPECT_EQ(w.settled(second), "done");
  EXPECT_NE(w.jobs->add(waiting("a")), first);
}

TEST(Jobs, WhatSomebodyLooksAtGoesBeforeWhatWasLeft) {
  const Workshop w("jobs-order");
  const std::string running = w.jobs->add(waiting("a"));
  EXPECT_TRUE(w.says(running, "3 of 20")) << "it is under way";
  EXPECT_EQ(w.jobs->ask(waiting("left"))["state"], "working");
  const std::string looked_at = w.jobs->ask(report("looked at"))["id"];
  w.jobs->stop(running);
  EXPECT_EQ(w.settled(looked_at), "done") << "although the other, which never ends, came first";
}

TEST(Jobs, WhatWaitsCanBeStopped) {
  const Workshop w("jobs-stop");
  const std::string running = w.jobs->add(waiting("a")), queued = w.jobs->add(report("b"));
  w.jobs->stop(queued);
  EXPECT_TRUE(w.says(running, "3 of 20"));
  w.jobs->stop(running);
  EXPECT_EQ(w.settled(queued), "failed");
  EXPECT_FALSE(std::filesystem::exists(w.place.jobs() / queued / "report"));
}

/// The disk is full when the result is to be kept: that job fails, the next is done.
TEST(Jobs, WhatFailsAfterwardsFailsTheJobAlone) {
  const Workshop w("jobs-then");
  JobRequest request = report("a");
  request.then = [](const std::filesystem::path&, bool) {
    throw Error("cannot be written", "settings.json", "Make room");
  };
  EXPECT_EQ(w.settled(w.jobs->add(std::move(request))), "failed");
  EXPECT_EQ(w.settled(w.jobs->add(report("b"))), "done");
}

TEST(Jobs, EndWithTheConsoleWhateverRunsOrWaits) {
  Workshop w("jobs-end");
  const std::string id = w.jobs->add(waiting("a"));
  for (int i = 0; i < 20; ++i) w.jobs->add(waiting("more " + std::to_string(i)));
  EXPECT_TRUE(w.says(id, "3 of 20"));
  w.jobs.reset();  // the first would wait a minute, the others one after the other as long
}

TEST(Jobs, UnknownOnesAreRefused) {
  const Workshop w("jobs-unknown");
  for (const std::string id : {"", "..", "../sessions/x", "20260301-123000-1a2b3c4d"}) {
    EXPECT_THROW(w.jobs->one(id), UsageError);
    EXPECT_THROW(w.jobs->stop(id), UsageError);
    EXPECT_THROW(w.jobs->page(id), UsageError);
  }
}

TEST(Jobs, OldFoldersGoAndNothingElse) {
  const test::ScratchFolder folder("jobs-old");
  ConsolePlace place;
  place.home = folder.path();
  for (int i = 0; i < 250; ++i)
    std::filesystem::create_directories(place.jobs() /
                                        ("20200101-000000-" + std::to_string(1000 + i)));
  std::filesystem::create_directories(place.jobs() / "not an id");
  const Jobs jobs(place);
  EXPECT_EQ(std::distance(std::filesystem::directory_iterator(place.jobs()), {}), 201);
  EXPECT_TRUE(std::filesystem::exists(place.jobs() / "20200101-000000-1249"));
  EXPECT_FALSE(std::filesystem::exists(place.jobs() / "20200101-000000-1000"));
}

TEST(Jobs, ManyAskAtOnce) {
  const Workshop w("jobs-many");
  std::atomic<int> bad{0};
  std::vector<std::thread> threads;
  for (int t = 0; t < 6; ++t)
    threads.emplace_back([&, t] {
      for (int i = 0; i < 40; ++i) {
        const std::string id = w.jobs->add(report("key " + std::to_string((t + i) % 3)));
        bad += !isId(w.jobs->one(id)["id"]);
        if (i % 7 == 0) w.jobs->stop(id);
        w.jobs->workingOn("key");
      }
    });
  for (std::thread& thread : threads) thread.join();
  EXPECT_EQ(bad, 0);
}

TEST(Jobs, HowFarItIsOfAnyLine) {
  EXPECT_EQ(fractionOf({"3 of 20"}), 0.15);
  EXPECT_EQ(fractionOf({"1 of 2", "2 of 2 pictures"}), 1);
  for (const char* line : {"", " of ", "of", "3 of", "of 3", "x of y", "3 of 0", "5 of 4",
                           "-1 of 4x", "99999999999999999999 of 1"}) {
    const nlohmann::json far = fractionOf({line});
    EXPECT_TRUE(far.is_null() || (far >= 0 && far <= 1)) << line;
  }
  EXPECT_TRUE(fractionOf({}).is_null());
}

}  // namespace
}  // namespace palpa::console
