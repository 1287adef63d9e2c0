#include "apps/record/store/study_store.h"

#include <algorithm>
#include <set>
#include <thread>

#include "apps/record/store/migrations.h"
#include "tests/store/stores.h"

namespace palpa::record {
namespace {

class Studies : public Store {
 protected:
  static StudyBeginning beginning(const std::string& sha = "abc") {
    return {"pilot", sha, 0xfedcba9876543210u, "2026-03-01T10:00:00Z"};
  }
  static Enrolment wanted(const std::string& trainee, const std::string& group = "novice") {
    return {"pilot", trainee, group, 0, "", false, "2026-03-02T10:00:00Z"};
  }
  static std::string draw(std::uint64_t seed, std::int64_t place) {
    return std::to_string(seed) + (place % 2 ? " odd" : " even");
  }
  static Enrolment enrol(RecordStore& store, const std::string& trainee,
                         const std::string& group = "novice") {
    return StudyStore(store).enrol(beginning(), wanted(trainee, group), draw);
  }
};
INSTANTIATE_TEST_SUITE_P(Both, Studies, testing::Values("SQLite", "PostgreSQL"),
                         [](const auto& p) { return std::string(p.param); });

std::string complaintOf(const std::function<void()>& action) {
  try {
    action();
  } catch (const UsageError& e) {
    return e.what();
  }
  return "";
}

TEST_P(Studies, GiveThePlacesOfEachGroupInTurn) {
  RecordStore store(url);
  for (const char* id : {"A", "B", "C"}) store.addTrainee(novice(id));
  EXPECT_EQ(enrol(store, "A").place, 1);
  EXPECT_EQ(enrol(store, "B", "experienced").place, 1);
  const Enrolment c = enrol(store, "C");
  EXPECT_EQ(c.place, 2);
  EXPECT_EQ(c.condition, "18364758544493064720 even");       // the seed comes back whole
  const Enrolment again = enrol(store, "C", "experienced");  // enrolled is enrolled
  EXPECT_EQ(again.place, 2);
  EXPECT_EQ(again.group, "novice");
  StudyStore studies(store);
  EXPECT_EQ(studies.placesGiven("pilot", "novice"), 2);
  EXPECT_EQ(studies.placesGiven("pilot", "experienced"), 1);
  EXPECT_EQ(studies.placesGiven("pilot", "nobody"), 0);
  EXPECT_EQ(studies.enrolments("pilot").size(), 3u);
  EXPECT_FALSE(studies.enrolment("other", "A"));
}

TEST_P(Studies, TheSeedIsOfTheFirstAndTheFileMustStay) {
  RecordStore store(url);
  for (const char* id : {"A", "B"}) store.addTrainee(novice(id));
  enrol(store, "A");
  StudyBeginning later = beginning();
  later.seed = 5;
  EXPECT_EQ(StudyStore(store).enrol(later, wanted("B"), draw).condition,
            "18364758544493064720 even");
  const std::string complaint =
      complaintOf([&] { StudyStore(store).enrol(beginning("other"), wanted("B"), draw); });
  EXPECT_NE(complaint.find("began on 2026-03-01 with another protocol"), std::string::npos)
      << complaint;
  EXPECT_NE(complaintOf([&] { enrol(store, "Z"); }).find("is not in the records"),
            std::string::npos);
  EXPECT_EQ(StudyStore(store).placesGiven("pilot", "novice"), 2);  // no place was lost on the way
}

TEST_P(Studies, AFailedDrawUsesNoPlace) {
  RecordStore store(url);
  store.addTrainee(novice("A"));
  EXPECT_THROW(StudyStore(store).enrol(beginning(), wanted("A"),
                                       [](std::uint64_t, std::int64_t) -> std::string {
                                         throw Error("no", "draw", "Again");
                                       }),
               Error);
  EXPECT_EQ(enrol(store, "A").place, 1);
}

/// Several stations enrol at once, some of them the same trainee.
TEST_P(Studies, NoPlaceIsGivenTwice) {
  constexpr int kDesks = 4, kEach = 6, kTrainees = 12;
  {
    RecordStore store(url);
    for (int i = 0; i < kTrainees; ++i) store.addTrainee(novice("T" + std::to_string(i)));
  }
  std::vector<std::thread> stations;
  for (int s = 0; s < kDesks; ++s)
    stations.emplace_back([&, s] {
      RecordStore store(url);
      for (int i = 0; i < kEach; ++i) enrol(store, "T" + std::to_string((s * 3 + i) % kTrainees));
    });
  for (std::thread& station : stations) station.join();
  RecordStore store(url);
  const std::vector<Enrolment> all = StudyStore(store).enrolments("pilot");
  ASSERT_EQ(all.size(), static_cast<std::size_t>(kTrainees));
  for (std::size_t i = 0; i < all.size(); ++i)
    EXPECT_EQ(all[i].place, static_cast<std::int64_t>(i + 1));
}

TEST_P(Studies, KeepTheFirstAnswer) {
  RecordStore store(url);
  store.addTrainee(novice("A"));
  enrol(store, "A");
  StudyStore studies(store);
  studies.answer({"pilot", "A", 1, "useful", "q", "4", "2026-03-02T10:00:00Z"});
  studies.answer({"pilot", "A", 1, "useful", "q", "1", "2026-03-02T11:00:00Z"});
  studies.answer({"pilot", "A", 2, "useful", "q", "It's ü", "2026-03-03T10:00:00Z"});
  const std::vector<ItemAnswer> answers = studies.answers("pilot", "A");
  ASSERT_EQ(answers.size(), 2u);
  EXPECT_EQ(answers[0].answer, "4");
  EXPECT_EQ(answers[1].session, 2);
  EXPECT_EQ(answers[1].answer, "It's ü");
  EXPECT_EQ(studies.answers("pilot").size(), 2u);
  EXPECT_THROW(studies.answer({"pilot", "B", 1, "useful", "q", "4", ""}),
               Error);  // nobody enrolled
}

TEST_P(Studies, GoWithThePersonButThePlaceStaysUsed) {
  RecordStore store(url);
  for (const char* id : {"A", "B"}) store.addTrainee(novice(id));
  enrol(store, "A");
  StudyStore(store).answer({"pilot", "A", 1, "useful", "q", "4", ""});
  store.deletePerson("A", "2026-04-01T00:00:00Z");
  EXPECT_TRUE(StudyStore(store).enrolments("pilot").empty());
  EXPECT_TRUE(StudyStore(store).answers("pilot").empty());
  EXPECT_EQ(enrol(store, "B").place, 2);
}

TEST_P(Studies, AreInABackup) {
  {
    RecordStore store(url);
    store.addTrainee(novice("A"));
    enrol(store, "A");
    StudyStore(store).answer({"pilot", "A", 1, "useful", "q", "4", ""});
  }
  const std::string file = (folder / "backup.sqlite").string();
  copyStore(*connect(url), *connect(file));
  RecordStore copy(file);
  EXPECT_EQ(StudyStore(copy).answers("pilot").size(), 1u);
  copy.addTrainee(novice("B"));
  EXPECT_EQ(enrol(copy, "B").place, 2);
}

}  // namespace
}  // namespace palpa::record
