#include "attacked.h"

#include "apps/runtime/clock.h"

namespace palpa::console_attack {

std::unique_ptr<ShortFolder> Attacked::folder_;
std::unique_ptr<Console> Attacked::console_;
std::string Attacked::session_;
std::size_t Attacked::noted_ = 0;

void Attacked::beginAll() {
  folder_ = std::make_unique<ShortFolder>();
  console_ = std::make_unique<Console>(folder());
  EXPECT_EQ(console()
                .post("/api/trainees", {{"id", "T017"},
                                        {"group", kMarkup},
                                        {"experience", kMarkup},
                                        {"handedness", "right"},
                                        {"consent", true}})
                .status,
            201);
}

void Attacked::endAll() {
  if (!console_) return;
  if (!session_.empty()) {
    console().post("/api/sessions/" + session_ + "/command", {{"command", "leave"}});
    EXPECT_TRUE(inTime([] {
      return console().get("/api/sessions/" + session_).json().value("state", "") != "running";
    }));
  }
  session_.clear();
  console_.reset();
  folder_.reset();
}

void Attacked::SetUp() {
  if (!console_) beginAll();
  noted_ = console().refused().size();
}

/// After the last test of the program.
class Ending : public ::testing::Environment {
  void TearDown() override { Attacked::endAll(); }
};
namespace {
[[maybe_unused]] ::testing::Environment* const ending =
    ::testing::AddGlobalTestEnvironment(new Ending);
}

const std::string& Attacked::session() {
  if (!session_.empty() &&
      console().get("/api/sessions/" + session_).json().value("state", "") == "running")
    return session_;
  const Answer begun = console().post(
      "/api/sessions",
      {{"task", "paracentesis"}, {"trainee", "T017"}, {"operator", "expert"}, {"trials", 50}});
  EXPECT_EQ(begun.status, 201) << begun.body;
  session_ = begun.json().value("id", "");
  EXPECT_TRUE(inTime([] {
    return console().get("/api/sessions/" + session_).json().value("state", "") == "running";
  }));
  return session_;
}

::testing::AssertionResult Attacked::goesOn() {
  const std::string id = session();
  const auto knows = console().events(id, "", [](const auto& all) { return !all.empty(); });
  if (knows.empty()) return ::testing::AssertionFailure() << "the session tells nothing";
  double first = -1, later = -1;
  std::size_t seen_until = 0;
  console().events(id, "", [&](const auto& all) {
    for (; seen_until < all.size(); ++seen_until) {
      const auto t = all[seen_until].data.value("t_s", nlohmann::json());
      const double t_s = t.is_array() && !t.empty() ? t.back().template get<double>()
                         : t.is_number()            ? t.template get<double>()
                                                    : -1;
      later = std::max(later, t_s);
    }
    if (first < 0) first = later;  // what was told until now
    return later > first + 0.3;
  });
  if (later > first + 0.3) return ::testing::AssertionSuccess();
  return ::testing::AssertionFailure()
         << "stands still at " << later << " s: " << console().get("/api/sessions/" + id).body;
}

::testing::AssertionResult Attacked::isNoted(const std::string& words) {
  const auto there = [&] {
    const std::string all = console().refused();
    return (all.size() >= noted_ ? all.substr(noted_) : all).find(words) != std::string::npos;
  };
  for (int tries = 0; tries < 100; ++tries) {  // it is noted after the answer
    if (there()) return ::testing::AssertionSuccess();
    runtime::rest(std::chrono::milliseconds(50));
  }
  return ::testing::AssertionFailure()
         << "nothing of \"" << words << "\" in\n"
         << console().refused().substr(std::min(noted_, console().refused().size()));
}

}  // namespace palpa::console_attack
