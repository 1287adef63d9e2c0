#include "apps/session/needle_session.h"
#include "apps/training/trial_words.h"

#include <algorithm>
#include <cstdio>
#include <optional>
#include <sstream>
#include <tuple>

#include "anatomy/base/error.h"
#include "anatomy/base/whole_file.h"
#include "apps/evidence/rating_forms.h"
#include "apps/evidence/recorded_session.h"
#include "apps/report/needle/session_report.h"
#include "apps/session/needle_world.h"
#include "apps/session/output_folder.h"
#include "apps/session/session_facts.h"
#include "apps/station/overlay_error.h"

namespace palpa::session {
namespace {

/// `forms`: of an assessment, whose trials are judged; null: practice.
std::vector<report::TrialPage> pages(const std::vector<task_needle::CompletedTrial>& trials,
                                     const std::vector<trial::SavedPicture>& pictures,
                                     const evidence::RatingForms* forms) {
  std::vector<report::TrialPage> all;
  for (const auto& trial : trials) {
    report::TrialPage page{trial.assessment, {}, {}};
    for (const auto& p : pictures)
      if (p.moment.trial == trial.assessment.trial)
        page.pictures.push_back({p.file, p.moment.caption, p.moment.t_s});
    if (forms && training::inAssessment(trial.assessment.role) && trial.assessment.by_path) {
      page.verdict = evidence::verdictOf(trial.assessment, *forms, {},
                                         evidence::standardOf(forms->checklist, 0));
      page.certification = competence::whatCannotBeCertified(static_cast<int>(trials.size()));
    }
    all.push_back(std::move(page));
  }
  return all;
}

/// From the evidence, as `palpa report trial` reads them.
report::Courses<assess::TrialSample> coursesIn(const std::filesystem::path& evidence,
                                               const Pose& X_DA) {
  return [evidence, X_DA](const auto& draw) {
    evidence::eachNeedleTrial(
        record::SessionReader(evidence), X_DA,
        [&](const record::RecordedTrial& trial, const evidence::NeedleSamples& samples) {
          draw(trial.header.trial, evidence::thinned(samples));
        });
  };
}

/// With the needle's tip at the entry point, upright.
report::Fact predictedOverlay(const SessionResult& result, const NeedleWorld& world) {
  const char* const name = "Overlay at the needle's tip, predicted error";
  if (!result.board || world.station.calibrations.empty())
    return {name, "not known",
            "the station was not calibrated by this program: palpa calibrate all"};
  const Pose X_WT = makePose(rotationWithZ(-Vec3::UnitZ()),
                             world.X_WA * world.patient.landmark(anatomy::landmark::kEntry));
  const auto error = station::predictOverlayError(
      world.station, world.station.X_WD.inverse() * X_WT * world.station.X_ET.inverse(),
      *result.board);
  if (!error) return {name, "not known", "tool or registration is not calibrated"};
  const auto& all = world.station.calibrations;
  const bool simulated =
      std::any_of(all.begin(), all.end(), [](const auto& c) { return c.file.simulated; });
  return {name, format("%.2f mm, %.2f px", error->mm, error->px),
          std::string("root mean square, at the entry point, by the spreads of the calibrations") +
              (simulated ? " (simulated)" : "")};
}

std::vector<report::Fact> registrationFacts(const SessionResult& result, const NeedleWorld& world) {
  std::vector<report::Fact> facts{predictedOverlay(result, world)};
  if (result.accuracy) {
    const twin::BenchAccuracy& a = *result.accuracy;
    facts.push_back({"Registration error at the entry point, median",
                     format("%.2f mm", a.entry_median_mm),
                     format("camera at %.2f m; simulated truth against estimate", a.distance_m)});
    facts.push_back(
        {"The same, 95 % of pictures below", format("%.2f mm", a.entry_p95_mm), "simulated truth"});
    facts.push_back({"Needle tip's registration at the entry point", format("%.2f mm", a.tool_mm),
                     "haptic base and tool calibration; simulated truth"});
    facts.push_back(
        {"Pictures with the board found", format("%zu of %zu", a.registered, a.pictures), ""});
  }
  for (const RegistrationRow& row : result.registration)
    facts.push_back({row.source, row.points ? format("rms %.2f px", row.rms_px) : "no board found",
                     row.points ? format("%d points, camera at %.2f m", row.points,
                                         row.X_CW.translation().norm())
                                : ""});
  return facts;
}

std::string scoredBy(const NeedleWorld& world) {
  const std::string& version = world.task.rules.version;
  return version == assess::kPublishedRules ? version : "rules " + version;
}

/// What differs between versions.
std::string whatIsScored(const NeedleWorld& world) {
  const assess::ScoringRules& rules = world.task.rules;
  const bool own = world.expert_path->axes == calibration::PathAxes::own_line;
  return std::string(own ? "about this patient's own line" : "one path for every patient") +
         (rules.weights.phase_2 == assess::Phase2Weight::continuous
              ? "; the weight of PHASE_2 is continuous"
              : "; PHASE_2 weighs in steps") +
         (rules.bone_unit == assess::BoneUnit::contacts ? "; bone is counted by contacts"
                                                        : "; bone is counted by samples") +
         (rules.told_within_s > 0 ? "; what is aspirated is asked" : "");
}

/// To a station's facts those of this patient and task.
std::vector<report::Fact> needleFacts(std::vector<report::Fact> facts,
                                      const SessionOptions& options, const NeedleWorld& world) {
  if (world.task.block)
    facts.insert(facts.begin() + 3,
                 {"Phantom", "a block",
                  format("%.0f x %.0f x %.0f mm", 1e3 * world.task.block->size.x(),
                         1e3 * world.task.block->size.y(), 1e3 * world.task.block->size.z())});
  else
    facts.insert(facts.begin() + 3, {"Patient", world.patient.name,
                                     std::string(anatomy::name(world.patient.side)) + " side"});
  for (report::Fact& fact : steadyingFacts(options, world.task.augmentations, world.station))
    facts.push_back(std::move(fact));
  if (!world.not_scored.empty()) facts.push_back({"Score", "none", world.not_scored});
  if (world.expert_path) {
    facts.push_back({"Expert path", format("from %d expert trials", world.expert_path->trials),
                     world.expert_path->simulated ? "simulated experts" : ""});
    facts.push_back({"Scored by", scoredBy(world), whatIsScored(world)});
  }
  return facts;
}

void writeRegistration(const std::vector<RegistrationRow>& rows,
                       const std::filesystem::path& file) {
  std::ostringstream csv;
  csv << "picture,found,points,rms_px,t_x_m,t_y_m,t_z_m,q_w,q_x,q_y,q_z\n";
  for (const RegistrationRow& row : rows) {
    const PackedPose X = pack(row.X_CW);
    csv << std::filesystem::path(row.source).filename().string() << ',' << (row.points ? 1 : 0)
        << ',' << row.points
        << format(",%.4f,%.6f,%.6f,%.6f,%.8f,%.8f,%.8f,%.8f\n", row.rms_px, X.p[0], X.p[1], X.p[2],
                  X.q[0], X.q[1], X.q[2], X.q[3]);
  }
  writeWhole(file, csv.str());
}

void sayResult(const SessionResult& result) {
  for (const auto& trial : result.trials) {
    const assess::TrialAssessment& a = trial.assessment;
    const std::string total = a.by_path && !a.penalties.empty()
                                  ? format(" Total penalty %.1f (lower is better)", a.total)
                                  : "";
    std::printf("Trial %d (%s%s): %s%s\n", a.trial, training::nameOf(a.role).c_str(),
                a.simulated ? ", simulated" : "",
                a.summary.empty() ? training::nameOf(a.outcome).c_str() : a.summary.c_str(),
                total.c_str());
  }
}

}  // namespace

ReportHead headOf(const SessionOptions& options, const NeedleWorld& world) {
  const std::string side =
      world.task.block ? "" : std::string(", ") + anatomy::name(world.patient.side) + " side";
  ReportHead head = headOf(options, world.task.title + side, world.task.taxonomy, world.station,
                           isSimulated(options, world));
  head.station = needleFacts(std::move(head.station), options, world);
  head.parts = meaningsOf(world.task.augmentations);
  head.doses = noDoses(world.tickConfig().augmentations, world.task.augmentations);
  return head;
}

void writeNeedleResults(const ReportHead& head,
                        const std::vector<task_needle::CompletedTrial>& trials,
                        const ReportTail& tail, const Pose& X_DA,
                        std::optional<assess::NeedleViews> views,
                        const std::filesystem::path& evidence) {
  std::vector<assess::TrialAssessment> scored;
  for (const auto& trial : trials)
    if (training::countsAsScored(trial.assessment.role) &&
        trial.assessment.outcome != training::Outcome::voided)
      scored.push_back(trial.assessment);
  const std::filesystem::path folder = evidence.parent_path();
  report::writeTrialsCsv(head.user_id, scored, folder / "trials.csv", head.doses);
  if (!head.page) return;
  report::SessionReport page;
  static_cast<report::SessionPage&>(page) = pageOf(
      head, tail, evidence, training::Engine::needle, judgedOf(trials, [&](const auto& t) {
        return progress::JudgedTrial{t.assessment.role, t.assessment.outcome, t.assessment.metrics};
      }));
  const std::optional<evidence::RatingForms> forms =
      head.assessed ? std::optional(evidence::readForms("", "")) : std::nullopt;
  page.trials = pages(trials, tail.pictures, forms ? &*forms : nullptr);
  page.courses = coursesIn(evidence, X_DA);
  page.views = std::move(views);
  page.registration = tail.registration;
  page.parts = partsOf(head.parts, trials, [](const auto& t) {
    return std::tuple(t.assessment.doses, t.assessment.augmented,
                      1e-3 * t.assessment.values.time_ms);
  });
  report::writeReport(page, folder / "report.html");
}

void writeOutcome(const SessionOptions& options, const NeedleWorld& world,
                  const SessionResult& result, const std::filesystem::path& folder) {
  writeNeedleResults(
      headOf(options, world), result.trials,
      {result.pictures, runNotes(result), registrationFacts(result, world)}, world.X_DA,
      world.taught_path ? std::optional(assess::needleViewsOf(world.patient, *world.taught_path))
                        : std::nullopt,
      folder / "session.palpa");
  if (!result.registration.empty())
    writeRegistration(result.registration, folder / "registration.csv");

  sayResult(result);
  if (!world.not_scored.empty()) std::printf("Not scored: %s\n", world.not_scored.c_str());
  if (options.report)
    sayWritten(result, folder, "what happened, with reasons and pictures", "trial");
}

}  // namespace palpa::session
