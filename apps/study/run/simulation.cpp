#include <cstdio>
#include <functional>
#include <map>
#include <memory>
#include <string>

#include "anatomy/base/counted.h"
#include "anatomy/base/error.h"
#include "anatomy/base/random.h"
#include "apps/evidence/evidence_records.h"
#include "apps/os/worker_processes.h"
#include "apps/runtime/clock.h"
#include "apps/session/needle_session.h"
#include "apps/session/output_folder.h"
#include "apps/session/search_session.h"
#include "apps/session/session_pictures.h"
#include "apps/session/terminal.h"
#include "apps/study/learning.h"
#include "apps/study/protocol.h"
#include "apps/study/run/participant.h"
#include "apps/study/run/session.h"
#include "apps/study/run/study_run.h"
#include "apps/training/engine.h"

namespace palpa::study {
namespace {

constexpr std::int64_t kLook_ns = 200 * runtime::kMillisecond;

using Work = std::function<void(std::size_t, const std::function<void()>&)>;

/// Does `work(0)` ... `work(items - 1)` in so many processes at a time. What is ready before
/// (patients, files) is shared, not copied; nothing that is open (a store) may be. `steps`: how
/// much there is to do in all; `work` says each step done with `step()`, and progress is shown.
/// Throws Error with the first message when one failed; those that were begun are done first.
void shareWork(std::size_t items, int workers, int steps, bool quiet, const Work& work) {
  session::WorkProgress progress("trials", steps, quiet);
  os::WorkerPool pool(static_cast<std::size_t>(workers));
  std::string failure;
  int done = 0;
  for (std::size_t next = 0; !pool.isIdle() || (next < items && failure.empty());) {
    progress.done(done);
    while (next < items && failure.empty() && !pool.isFull()) {
      const std::size_t item = next++;
      pool.start(item, [&work, item](const os::Report& report) {
        work(item, [&report] { report("a step"); });
      });
    }
    for (const os::WorkerNews& news : pool.await(kLook_ns)) {
      done += static_cast<int>(news.lines.size());
      if (failure.empty()) failure = news.failure;
    }
  }
  if (!failure.empty())
    throw Error(failure, "a virtual trainee",
                "Start again: what is done is kept, the same command continues");
}

namespace fs = std::filesystem;
using study::Next;

struct Subject {
  record::Enrolment enrolment;
  std::uint64_t seed = 0;
};

/// What subjects of a study share: read and built once, before the processes part.
struct Shared {
  const StudyOptions& options;
  const study::Protocol& protocol;
  const study::Learners& learners;
  std::map<fs::path, std::unique_ptr<session::NeedleWorld>> needle_worlds;  ///< by task file
};

std::string idOf(int number) {
  char text[16];
  std::snprintf(text, sizeof text, "S%03d", number);
  return text;
}

/// Pictures of the board serve the ready check alone: no score depends on them, and at 15 Hz they
/// cost most of the time. The check wants one within 1.5 s.
constexpr double kPicturesOfCohort_Hz = 0.8;

void buildWorlds(Shared& shared) {
  for (const study::Session& session : shared.protocol.sessions)
    for (const study::Block& block : session.blocks) {
      if (block.engine != training::Engine::needle || shared.needle_worlds.count(block.task))
        continue;
      session::SessionOptions options = shared.options.session;
      options.task = block.task.string();
      auto& world = shared.needle_worlds[block.task] =
          std::make_unique<session::NeedleWorld>(options);
      world->station.camera_rate_Hz = kPicturesOfCohort_Hz;
      session::SessionPictures(options, world->station);  // refuses what cannot be tracked so
    }
}

/// In the order of their numbers, so that places and conditions follow from the seed.
std::vector<Subject> enrolAll(const StudyOptions& o, const study::Protocol& protocol,
                              const study::Learners& learners) {
  record::RecordStore store(o.url);
  record::StudyStore studies(store);
  std::vector<Subject> subjects;
  for (const study::Group& group : protocol.groups) {
    const int count = o.subjects ? o.subjects : learners.groups.at(group.name).subjects;
    for (int i = 0; i < count; ++i) {
      const std::string id = idOf(static_cast<int>(subjects.size()) + 1), now = runtime::utcNow();
      addSimulated(store, id, group.name, now);
      const record::Enrolment wanted{protocol.id, id, group.name, 0, "", true, now};
      const auto draw = [&](std::uint64_t seed, std::int64_t place) {
        return protocol.allocation
                   ? study::conditionOf(*protocol.allocation, group.name, seed, place)
                   : std::string();
      };
      subjects.push_back(
          {studies.enrol({protocol.id, protocol.sha256, o.seed, now}, wanted, draw),
           RandomStream(o.seed, "study.person." + group.name + "." + std::to_string(i)).bits()});
      if (subjects.back().enrolment.group != group.name)
        throw UsageError(
            "is enrolled in another group", "trainee " + id,
            "Go on with as many trainees of each group as before, or use other records");
    }
  }
  return subjects;
}

/// Whose skill at the trials to come follows from those that were done.
session::LearnerOptions learnerAt(const Shared& shared, const Subject& subject,
                                  const StudyParticipant& participant, const Next& next) {
  study::VirtualTrainee trainee(shared.learners, subject.enrolment.group, subject.seed);
  int trials = 0;
  for (const study::DoneTrial& done : participant.done()) {
    if (!done.counts()) continue;
    const std::string& fixed = shared.protocol.block(done.step).condition;
    trainee.practised(fixed.empty() ? subject.enrolment.condition : fixed);
    ++trials;
  }
  std::vector<double> levels;
  for (int i = 0; i < next.trials; ++i, trainee.practised(next.condition))
    levels.push_back(trainee.level());
  return {shared.learners.from.string(), shared.learners.to.string(),
          [levels](int trial) { return levels.at(static_cast<std::size_t>(trial - 1)); },
          subject.seed + static_cast<std::uint64_t>(trials)};
}

bool runTrials(const Shared& shared, const session::SessionOptions& session,
               const study::Block& block, const fs::path& folder) {
  if (block.engine == training::Engine::needle)
    return !session::runNeedleSession(session, *shared.needle_worlds.at(block.task), folder).quit;
  return !session::runSearch(session, session::SearchWorld(session), folder).quit;
}

void runSubject(const Shared& shared, const Subject& subject, const std::function<void()>& step) {
  const std::string& id = subject.enrolment.trainee;
  StudyParticipant participant(shared.protocol, id, shared.options.url, shared.options.seed);
  for (std::size_t i = 0; i < participant.trials(); ++i) step();
  for (Next next; (next = participant.next(runtime::utcNow())).kind == NextKind::trials;) {
    session::SessionOptions session =
        studySession(shared.options.session, shared.protocol, subject.enrolment, next);
    session.learner = learnerAt(shared, subject, participant, next);
    const fs::path folder = session::makeOutputFolder(
        studyFolder(shared.options.session.out, shared.protocol, id, next).string(), "");
    const std::size_t before = participant.trials();
    if (!runTrials(shared, session, shared.protocol.block(next.step), folder))
      throw Error("was interrupted", id, "The same command continues");
    evidence::deliverEvidence(folder / "session.palpa", shared.options.url);
    participant.refresh();
    if (participant.trials() == before)
      throw Error("no trial ended", folder.string(), "See the session's events");
    for (std::size_t i = before; i < participant.trials(); ++i) step();
  }
}

int trialsOf(const study::Protocol& protocol) {
  int trials = 0;
  for (const study::Session& session : protocol.sessions)
    for (const study::Block& block : session.blocks) trials += block.trials;
  return trials;
}

}  // namespace

void simulateStudy(const StudyOptions& given) {
  StudyOptions o = given;
  const study::Protocol protocol = study::readProtocol(o.protocol);
  const study::Learners learners = study::readLearners(o.learners, protocol);
  if (o.seed == 0) o.seed = 1;
  o.session.who = session::OperatorKind::learner;
  o.session.fast = o.session.no_views = o.session.quiet = true;
  o.session.display = scene::Display::offscreen;
  session::settle(o.session);
  if (o.session.out.empty())
    o.session.out = session::makeOutputFolder("", "study-" + protocol.id).string();
  Shared shared{o, protocol, learners, {}};
  buildWorlds(shared);
  const std::vector<Subject> subjects = enrolAll(o, protocol, learners);
  std::printf("%s\n%s (%s). Planted: %s\n", protocol.title.c_str(),
              counted(subjects.size(), "simulated trainee").c_str(), learners.id.c_str(),
              learners.planted.c_str());
  shareWork(subjects.size(), o.workers, static_cast<int>(subjects.size()) * trialsOf(protocol),
            given.session.quiet, [&](std::size_t item, const std::function<void()>& step) {
              runSubject(shared, subjects[item], step);
            });
  const auto trials = static_cast<std::size_t>(trialsOf(protocol));
  std::printf("Simulated: %s with %s each, in the records %s\n",
              counted(subjects.size(), "trainee").c_str(), counted(trials, "trial").c_str(),
              o.url.c_str());
  std::printf("Evidence: %s\nVirtual trainees answer no questionnaires\n", o.session.out.c_str());
}

}  // namespace palpa::study
