#include "apps/evidence/recorded_session.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <unordered_map>

#include <nlohmann/json.hpp>

#include "anatomy/base/error.h"
#include "anatomy/base/json_file.h"
#include "anatomy/base/json_text.h"
#include "anatomy/patient/patient_check.h"
#include "anatomy/patient/patient_file.h"
#include "apps/assess/dose_counter.h"
#include "apps/assess/needle/assess_trial.h"
#include "apps/assess/needle/needle_metrics.h"
#include "apps/record/session_file.h"
#include "apps/task_needle/needle_task.h"
#include "apps/training/trial_words.h"
#include "haptics/loop/tick.h"

namespace palpa::evidence {
namespace {

Pose poseFrom(const nlohmann::json& told) {
  return unpack(PackedPose{told.at("p_m").get<Packed3>(), told.at("q_wxyz").get<Packed4>()});
}

}  // namespace

RecordedSession::RecordedSession(const std::filesystem::path& file)
    : reader_(std::make_unique<record::SessionReader>(file)) {
  const record::SessionInfo& info = reader_->info();
  try {
    const nlohmann::json session = parseJson(info.session_json);
    X_DA_ = poseFrom(session.at("X_DA"));
    simulated_ = session.at("simulated").get<bool>();
    operator_ = session.at("operator").get<std::string>();
    trainee_ = session.value("trainee", "");
  } catch (const nlohmann::json::exception& e) {
    throw Error("the session's description is damaged (" + whyNoJson(info.session_json, e) + ")",
                file.string(), "Restore the file from a backup");
  }
  const std::string patient = file.string() + ", its patient";
  patient_ = anatomy::patientOfGlb(info.patient_glb, patient);
  query_ = std::make_unique<anatomy::SurfaceQuery>(patient_);
  task_ = task_needle::readTask(JsonFile::ofText(info.task_json, file.string() + ", its task"));
  if (!task_.block) anatomy::requireForNeedle(patient_, patient);
  if (!info.expert_path_json.empty())
    taught_path_ =
        calibration::parseExpertPath(info.expert_path_json, file.string() + ", its expert path")
            .onBody(assess::teachingLineOf(patient_, *query_));
  trials_ = reader_->trials();
}

namespace {

/// Every trial and all its judged ticks; `tick` sees the others, too.
void walkNeedle(
    const record::SessionReader& reader, const Pose& X_DA, const record::TrialVisitor& besides,
    const std::function<void(const record::RecordedTrial&, const NeedleSamples&)>& visit) {
  assess::TrialSampler sampler(X_DA.inverse(), reader.info().tick_config.X_ET);
  NeedleSamples samples;
  record::walkTrials(
      reader, reader.trials(),
      {.begin =
           [&](const record::RecordedTrial& trial) {
             samples.clear();
             sampler.begin(static_cast<std::uint32_t>(trial.header.trial));
             if (besides.begin) besides.begin(trial);
           },
       .tick =
           [&](const haptics::FlightRecord& record) {
             assess::TrialSample sample;
             if (sampler.add(record, &sample)) samples.push_back(sample);
             if (besides.tick) besides.tick(record);
           },
       .finish = [&](const record::RecordedTrial& trial) { visit(trial, samples); }});
}

}  // namespace

void eachNeedleTrial(
    const record::SessionReader& reader, const Pose& X_DA,
    const std::function<void(const record::RecordedTrial&, const NeedleSamples&)>& visit) {
  walkNeedle(reader, X_DA, {}, visit);
}

assess::TrialAssessment RecordedSession::judged(const record::RecordedTrial& trial,
                                                const Samples& samples) const {
  const assess::TrialFacts facts{trial.header.trial, training::roleNamed(trial.header.role),
                                 simulated_,         trial.header.force_feedback,
                                 trial.header.seed,  training::outcomeNamed(trial.end.outcome)};
  if (!task_.goal && taught_path_)
    return assess::assessTrial(facts, samples, patient_, *query_, *taught_path_, task_.rules);
  if (!task_.goal) return task_needle::judgedWithoutPath(facts, nullptr, samples, task_.rules);
  task_needle::GoalTrial goal(*task_.goal, task_.augmentations.subtaskNames(), task_.words);
  for (const assess::TrialSample& sample : samples) goal.add(sample);
  return task_needle::judgedWithoutPath(facts, &goal, samples, task_.rules);
}

assess::TrialAssessment RecordedSession::rescore(const record::RecordedTrial& trial,
                                                 const Samples& samples) const {
  if (!task_.goal && !taught_path_)
    throw Error("no expert path was recorded", "session",
                "It was made to calibrate experts, not to be scored");
  return judged(trial, samples);
}

std::vector<RecordedNeedle> recordedNeedles(const RecordedSession& session) {
  const record::SessionInfo& info = session.reader().info();
  const bool augment =
      JsonFile::ofText(info.session_json, "the recorded session").flag("augment", false);
  assess::TrialDoses doses(info.tick_config.augmentations,
                           session.task().augmentations.subtaskNames());
  std::vector<RecordedNeedle> trials;
  walkNeedle(session.reader(), session.X_DA(),
             {.begin =
                  [&](const record::RecordedTrial& trial) {
                    doses.begin(static_cast<std::uint32_t>(trial.header.trial));
                  },
              .tick = [&](const haptics::FlightRecord& record) { doses.add(record); },
              .finish = {}},
             [&](const record::RecordedTrial& trial, const NeedleSamples& samples) {
               trials.push_back({trial, session.judged(trial, samples)});
               assess::TrialAssessment& again = trials.back().again;
               again.augmented = augment && again.role != training::Role::familiarisation;
               again.doses = doses.doses();
             });
  return trials;
}

Likeness likeness(double recorded, double again) {
  if (recorded == again || (std::isnan(recorded) && std::isnan(again))) return Likeness::same_bits;
  const double most = kRounding * std::max({1.0, std::abs(recorded), std::abs(again)});
  return std::abs(recorded - again) <= most && std::isfinite(most) ? Likeness::rounding
                                                                   : Likeness::changed;
}

namespace {

Likeness likenessOfValues(const nlohmann::json& recorded, const nlohmann::json& again) {
  if (recorded.is_number() && again.is_number())
    return likeness(recorded.get<double>(), again.get<double>());
  if (recorded.type() != again.type() || recorded.size() != again.size()) return Likeness::changed;
  if (!recorded.is_structured()) return recorded == again ? Likeness::same_bits : Likeness::changed;
  Likeness worst = Likeness::same_bits;
  for (auto a = recorded.begin(), b = again.begin(); a != recorded.end(); ++a, ++b) {
    if (recorded.is_object() && a.key() != b.key()) return Likeness::changed;
    worst = worse(worst, likenessOfValues(*a, *b));
  }
  return worst;
}

}  // namespace

Likeness likenessOfJson(const std::string& recorded, const std::string& again) {
  return likenessOfValues(parseJson(recorded), parseJson(again));
}

namespace {

/// Whether what is no number agrees: where the tool is, and what happened.
bool sameWords(const haptics::FlightRecord& a, const haptics::FlightRecord& b) {
  return a.events == b.events && a.subtasks == b.subtasks && a.place == b.place &&
         a.phase == b.phase && a.tissue == b.tissue && a.bone == b.bone && a.wall == b.wall &&
         a.safety == b.safety;
}

/// Forces, torque and depth of a tick.
std::array<double, 13> comparedOf(const haptics::FlightRecord& r) {
  std::array<double, 13> all{};
  auto* next = all.data();
  for (const Packed3& v : {r.f_contact_D, r.f_command_D, r.tau_missing_D, r.f_augmentation_D})
    next = std::copy(v.begin(), v.end(), next);
  *next = r.depth;
  return all;
}

/// Whether the force is the recorded one, but for rounding.
bool count(const haptics::FlightRecord& recorded, const haptics::FlightRecord& again,
           ReplayCheck* check) {
  ++check->ticks;
  Likeness found = sameWords(recorded, again) ? Likeness::same_bits : Likeness::changed;
  const std::array<double, 13> was = comparedOf(recorded), is = comparedOf(again);
  double largest = 0;
  for (std::size_t i = 0; i < was.size(); ++i) {
    found = worse(found, likeness(was[i], is[i]));
    largest = std::max(largest, std::abs(was[i] - is[i]));
  }
  if (found == Likeness::same_bits) return true;
  if (check->different++ == 0) check->first_difference = recorded.tick;
  if (found == Likeness::rounding) check->largest = std::max(check->largest, largest);
  if (found != Likeness::changed) return true;
  if (check->changed++ == 0) check->first_change = recorded.tick;
  return false;
}

}  // namespace

Likeness ReplayCheck::likeness() const {
  return changed > 0 || ticks == 0 ? Likeness::changed
         : different > 0           ? Likeness::rounding
                                   : Likeness::same_bits;
}

namespace {

/// Two devices in one tick: from the first tick on, while none is missing.
ReplayCheck replayPairs(const record::SessionReader& reader, const record::VisitTick& visit) {
  const haptics::PairConfig& config = *reader.info().pair_config;
  ReplayCheck check;
  const auto state = std::make_unique<haptics::PairState>();
  std::optional<haptics::FlightRecord> first;
  const auto lost = [&](const haptics::FlightRecord& recorded) {
    if (first) visit(*first, nullptr);
    first.reset();
    visit(recorded, nullptr);
  };
  reader.ticks([&](const haptics::FlightRecord& recorded) {
    ++check.recorded;
    const bool follows = recorded.tool == 0 ? !first && recorded.tick == state->tools[0].tick
                                            : first && first->tick == recorded.tick;
    if (check.gaps == 0 && !follows) ++check.gaps;
    if (check.gaps > 0) return lost(recorded);
    if (recorded.tool == 0) {
      first = recorded;
      return;
    }
    std::array<haptics::TickForces, 2> forces;
    const std::array<haptics::FlightRecord, 2> again =
        haptics::tickPair(config, *state, {first->reading, recorded.reading}, first->commands,
                          recorded.t_ns, {first->sensed, recorded.sensed}, &forces);
    visit(*first, count(*first, again[0], &check) ? &forces[0] : nullptr);
    visit(recorded, count(recorded, again[1], &check) ? &forces[1] : nullptr);
    first.reset();
  });
  if (first) visit(*first, nullptr);
  return check;
}

ReplayCheck replaySingle(const record::SessionReader& reader,
                         const std::function<const haptics::Floor*(std::uint32_t number)>& floors,
                         const record::VisitTick& visit) {
  std::unordered_map<std::uint64_t, LocalGeometry> snapshots;
  reader.snapshots([&](const LocalGeometry& g) { snapshots[g.number] = g; });
  std::unordered_map<std::int64_t, haptics::TickState> keyframes;
  reader.keyframes(
      [&](std::int64_t tick, const haptics::TickState& state) { keyframes[tick] = state; });

  const haptics::TickConfig config = reader.info().tick_config;
  ReplayCheck check;
  haptics::TickState state;
  bool aligned = false;
  std::int64_t differed = 0;  // of the ticks since the state was taken from a keyframe
  reader.ticks([&](const haptics::FlightRecord& recorded) {
    ++check.recorded;
    const bool strayed = check.different > differed && keyframes.count(recorded.tick) > 0;
    if (!aligned || strayed || state.tick != recorded.tick) {
      if (aligned && state.tick != recorded.tick) ++check.gaps;
      const auto keyframe = keyframes.find(recorded.tick);
      aligned = keyframe != keyframes.end();
      if (!aligned) return visit(recorded, nullptr);  // wait for the next keyframe
      state = keyframe->second;
      differed = check.different;
    }
    const auto snapshot = snapshots.find(recorded.snapshot);
    haptics::TickForces forces;
    const haptics::FlightRecord again = haptics::tick(
        config, state, recorded.reading, snapshot == snapshots.end() ? nullptr : &snapshot->second,
        recorded.commands, recorded.t_ns, recorded.sensed,
        floors && recorded.commands.floor ? floors(recorded.commands.floor) : nullptr, &forces);
    visit(recorded, count(recorded, again, &check) ? &forces : nullptr);
  });
  return check;
}

}  // namespace

ReplayCheck replayTicks(const record::SessionReader& reader,
                        const std::function<const haptics::Floor*(std::uint32_t number)>& floors,
                        const record::VisitTick& visit) {
  const record::VisitTick each = visit ? visit : [](const auto&, const auto*) {};
  return reader.info().pair_config ? replayPairs(reader, each) : replaySingle(reader, floors, each);
}

namespace {

/// The parts of a session one after the other: their figures together.
class Together {
 public:
  void add(const assess::ForceBalance& part) {
    if (part.samples == 0) return;
    sum2_ += part.rms_N * part.rms_N * static_cast<double>(part.samples);
    all_.samples += part.samples;
    all_.largest_N = std::max(all_.largest_N, part.largest_N);
    all_.object_N = std::max(all_.object_N, part.object_N);
    all_.delay_s = part.delay_s;
    all_.rms_N = std::sqrt(sum2_ / static_cast<double>(all_.samples));
  }
  const assess::ForceBalance& all() const { return all_; }

 private:
  assess::ForceBalance all_;
  double sum2_ = 0;
};

}  // namespace

std::optional<assess::ForceBalance> recordedBalance(const record::SessionReader& reader) {
  constexpr std::size_t kPart = 200'000;  // ticks: what is held in memory at once
  const double mass = JsonFile::ofText(reader.info().station_json, "the recorded station")
                          .number("device/apparent_mass_kg", 0, 5);
  Together together;
  std::array<std::vector<haptics::FlightRecord>, 2> parts;  // of each tool
  const auto finish = [&] {
    for (std::vector<haptics::FlightRecord>& part : parts) {
      together.add(assess::balanceOf(part, mass));
      part.clear();
    }
  };
  reader.ticks([&](const haptics::FlightRecord& tick) {
    if (tick.reading.instrumented && tick.sensed.state == haptics::SensorState::valid)
      parts[tick.tool & 1].push_back(tick);
    if (parts[0].size() >= kPart) finish();
  });
  finish();
  if (together.all().samples == 0) return std::nullopt;
  return together.all();
}

std::vector<assess::TrialSample> thinned(const std::vector<assess::TrialSample>& samples) {
  constexpr std::size_t kKeep = 10;
  std::vector<assess::TrialSample> kept;
  std::uint32_t events = 0;
  for (std::size_t i = 0; i < samples.size(); ++i) {
    events |= samples[i].events;
    if (i % kKeep != 0 && i + 1 != samples.size()) continue;
    kept.push_back(samples[i]);
    kept.back().events = events;
    events = 0;
  }
  return kept;
}

}  // namespace palpa::evidence
