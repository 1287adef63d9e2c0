#include "apps/assess/needle/aspiration.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <memory>

#include "anatomy/base/random.h"
#include "anatomy/parametric/parametric_patient.h"
#include "anatomy/query/local_geometry_builder.h"
#include "apps/station/assets.h"
#include "apps/station/material_files.h"
#include "apps/task_needle/needle_task.h"
#include "haptics/loop/tick.h"
#include "tests/support/counts.h"

/// Aspirations on the reference patient: a needle led straight to a place in an organ, whatever its
/// way, and the plunger drawn there. Where the place lies is asked of the meshes; what comes into
/// the syringe, and what the task makes of an answer, of the program.
namespace palpa::task_needle {
namespace {

constexpr double kSpeed = 0.030, kAbove = 0.020;  // m/s; m over the skin
constexpr std::int64_t kTick = 1'000'000, kEveryFrame = 16;

struct Body {
  anatomy::Patient patient;
  anatomy::SurfaceQuery query{patient};
  anatomy::LocalGeometryBuilder geometry{patient, query};

  explicit Body(anatomy::Patient p) : patient(std::move(p)) {}
  double depthIn(Organ organ, const Vec3& p_A) const {
    double deepest = -1;
    for (std::size_t i = 0; i < patient.organs.size(); ++i)
      if (patient.organs[i].organ == organ)
        deepest = std::max(deepest, -query.closest(static_cast<int>(i), p_A).distance);
    return deepest;
  }
  /// No bone on the way.
  bool free(const Vec3& from_A, const Vec3& to_A) const {
    const Vec3 way = to_A - from_A;
    const auto hits = query.cast(from_A, way.normalized(), way.norm());
    return std::none_of(hits.begin(), hits.end(), [](const auto& h) { return isBone(h.organ); });
  }
};

const Body& body() {
  static const Body reference = [] {
    anatomy::PatientParameters p = anatomy::drawParameters(
        anatomy::readPopulation(station::assetFile("patients/reference.json").string()),
        anatomy::Side::right, 0);
    p.extent = anatomy::Extent::bust;
    return Body(anatomy::buildPatient(p));
  }();
  return reference;
}

const TaskSettings& theTask() {
  static const TaskSettings task = readTask(station::assetFile("tasks/paracentesis.json"));
  return task;
}

/// A straight way from outside the skin to a place in an organ.
struct Way {
  Vec3 from_A, to_A;
};

/// Well inside the organ, and in no other that gives blood or air.
bool isPlace(Organ organ, const Vec3& p_A) {
  constexpr double kWall = 0.0015;  // m
  for (const Organ other : {Organ::vein, Organ::artery, Organ::lung})
    if (other != organ && body().depthIn(other, p_A) > -kWall) return false;
  return body().depthIn(organ, p_A) > kWall;
}

Way wayInto(Organ organ, RandomStream& draw) {
  const Vec3 middle = body().patient.landmark(anatomy::landmark::kVeinTarget);
  const auto skin =
      static_cast<int>(&body().patient.organ(Organ::skin) - body().patient.organs.data());
  for (;;) {
    const Vec3 p =
        middle + 0.030 * Vec3(draw.uniform(-1, 1), draw.uniform(-1, 1), draw.uniform(-1, 1));
    if (!isPlace(organ, p)) continue;
    const anatomy::SurfacePoint over = body().query.closest(skin, p);
    const Vec3 lean(draw.normal(0, 0.2), draw.normal(0, 0.2), draw.normal(0, 0.2));
    const Vec3 from = over.p_A + kAbove * (over.n_A + lean).normalized();
    if (body().free(from, p)) return {from, p};
  }
}

/// The task, fed by a loop whose tool goes where it is led.
class LedNeedle {
 public:
  LedNeedle() {
    config_.materials =
        station::readNeedleFile(station::assetFile("materials/needle.json")).materials;
    config_.X_ET = pack(Pose::Identity());
    NeedleTaskSetup setup{.patient = body().patient,
                          .query = body().query,
                          .settings = theTask(),
                          .taught_path = nullptr,
                          .X_ET = config_.X_ET,
                          .calibration_problem = {},
                          .plan = {TrialPlan{}},
                          .places = {},
                          .augmentations = {},
                          .fixtures = {},
                          .answers = {2, 4, 8},
                          .said = {}};
    task_ = std::make_unique<NeedleTask>(setup, bus_, channels_, *executive_);
  }

  /// To the place, and the plunger drawn there until something is asked, or for two seconds.
  void aspirate(const Way& way) {
    const Vec3 axis = (way.to_A - way.from_A).normalized();
    const double length = (way.to_A - way.from_A).norm();
    for (double s = 0; s < length; s += kSpeed * 1e-3) step(way.from_A + s * axis, axis, 0);
    for (int i = 0; i < 2000 && !status().asked; ++i) step(way.to_A, axis, 1);
  }
  void hold(double seconds) {
    for (int i = 0; i < static_cast<int>(1000 * seconds); ++i) step(tip_A_, axis_A_, 1);
  }
  void say(assess::Taken taken) {
    channels_.requests_to_task.push(
        {trial::UserCommand::choose, std::to_string(1 + static_cast<int>(taken))});
    hold(0.1);
  }
  void press(std::uint32_t button) {
    buttons_ = button;
    hold(0.05);
    buttons_ = 0;
    hold(0.05);
  }
  const TaskStatus& status() {
    if (const TaskStatus* told = channels_.status_to_scene.read(now_)) status_ = *told;
    return status_;
  }
  training::Outcome outcome() const {
    return task_->completed().empty() ? training::Outcome::none
                                      : task_->completed().front().assessment.outcome;
  }
  const std::vector<CompletedTrial>& completed() const { return task_->completed(); }

 private:
  void step(const Vec3& tip_A, const Vec3& axis_A, double plunger) {
    tip_A_ = tip_A, axis_A_ = axis_A;
    now_ += kTick;
    const Pose X = makePose(rotationWithZ(axis_A), tip_A);
    if (const auto* told = bus_.task_to_haptic.read(now_)) commands_ = *told;
    if (count_ % 10 == 0)
      geometry_ = body().geometry.build(static_cast<std::uint64_t>(1 + count_), now_,
                                        {X, inserted_, entry_A_}, Pose::Identity());
    haptics::DeviceReading reading;
    reading.t_ns = now_;
    reading.sequence = static_cast<std::uint64_t>(1 + count_);
    reading.homed = 1;
    reading.plunger = plunger;
    reading.buttons = buttons_;
    reading.p_DE = pack(tip_A);
    reading.q_DE = pack(X).q;
    const haptics::FlightRecord record =
        haptics::tick(config_, state_, reading, &geometry_, commands_, now_);
    if (record.phase == haptics::NeedlePhase::inserted && !inserted_) entry_A_ = tip_A;
    inserted_ = record.phase == haptics::NeedlePhase::inserted;
    bus_.haptic_to_task.push(record);
    if (count_++ % kEveryFrame != 0) return;
    runtime::CameraView view;
    view.t_exposure_ns = now_;
    view.tracking = ar::TrackState::tracked;
    bus_.camera_to_task.publish(view, now_);
    task_->step(now_);
  }

  runtime::Bus bus_{runtime::TimeMode::virtual_time};
  TaskChannels channels_{runtime::TimeMode::virtual_time};
  std::unique_ptr<runtime::Executive> executive_ = runtime::makeVirtualExecutive();
  std::unique_ptr<NeedleTask> task_;
  haptics::TickConfig config_;
  haptics::TickState state_;
  haptics::TickCommands commands_;
  LocalGeometry geometry_;
  TaskStatus status_;
  Vec3 tip_A_ = Vec3::Zero(), axis_A_ = Vec3::UnitZ(), entry_A_ = Vec3::Zero();
  bool inserted_ = false;
  std::uint32_t buttons_ = 0;
  std::int64_t now_ = 0, count_ = 0;
};

constexpr std::pair<Organ, Tissue> kGives[] = {{Organ::vein, Tissue::vein_lumen},
                                               {Organ::artery, Tissue::artery_lumen},
                                               {Organ::lung, Tissue::lung},
                                               {Organ::muscle, Tissue::air}};

TEST(Aspiration, ShowsWhatTheTipIsIn) {
  RandomStream draw(31, "test.aspiration");
  for (int i = 0; i < test::counted(5, 50); ++i)
    for (const auto& [organ, gives] : kGives) {
      LedNeedle needle;
      needle.aspirate(wayInto(organ, draw));
      EXPECT_EQ(needle.status().flows, gives) << name(organ) << ' ' << i;
      EXPECT_EQ(needle.status().asked, gives != Tissue::air) << name(organ);
      EXPECT_EQ(needle.outcome(), training::Outcome::none) << "nobody has said anything yet";
    }
}

/// A success in an artery, or in the lung, is impossible whatever is said.
TEST(Aspiration, OnlyTheVeinToldRightIsSuccess) {
  using assess::Taken;
  using training::Outcome;
  RandomStream draw(32, "test.aspiration");
  for (const auto& [organ, gives] : kGives) {
    if (gives == Tissue::air) continue;
    for (const Taken said : {Taken::vein, Taken::artery, Taken::neither}) {
      LedNeedle needle;
      needle.aspirate(wayInto(organ, draw));
      ASSERT_TRUE(needle.status().asked);
      needle.say(said);
      const Outcome expected = !assess::isRight(said, gives) ? Outcome::mistaken
                               : gives == Tissue::vein_lumen ? Outcome::success
                                                             : Outcome::none;
      EXPECT_EQ(needle.outcome(), expected) << name(organ) << ", said " << assess::name(said);
      if (expected != Outcome::none) continue;
      needle.hold(3);
      EXPECT_FALSE(needle.status().asked) << "asked once";
      EXPECT_EQ(needle.outcome(), Outcome::none);
    }
  }
}

TEST(Aspiration, ADevicesButtonsTellItToo) {
  RandomStream draw(34, "test.aspiration");
  LedNeedle vein, artery;
  vein.aspirate(wayInto(Organ::vein, draw));
  vein.press(2);
  EXPECT_EQ(vein.outcome(), training::Outcome::success);
  artery.aspirate(wayInto(Organ::artery, draw));
  artery.press(1);  // no button for an answer
  EXPECT_EQ(artery.outcome(), training::Outcome::none);
  artery.press(8);
  EXPECT_EQ(artery.outcome(), training::Outcome::mistaken);
}

TEST(Aspiration, WhoSaysNothingForTenSecondsHasNotRecognisedIt) {
  RandomStream draw(33, "test.aspiration");
  LedNeedle needle;
  needle.aspirate(wayInto(Organ::vein, draw));
  needle.hold(9.8);
  EXPECT_EQ(needle.outcome(), training::Outcome::none);
  needle.hold(0.4);
  ASSERT_EQ(needle.outcome(), training::Outcome::mistaken);
  EXPECT_NE(needle.completed().front().reason.find("was not said"), std::string::npos)
      << needle.completed().front().reason;
}

}  // namespace
}  // namespace palpa::task_needle
