#pragma once

#include <filesystem>
#include <memory>
#include <nlohmann/json.hpp>

#include "anatomy/patient.h"
#include "apps/evidence/recorded_session.h"
#include "apps/replay/needle_replay.h"
#include "apps/training/engine.h"

namespace palpa::evidence {

/// One trial of a recorded session, ready to be shown in the scene, with its events as marks.
class RecordedShow {
 public:
  virtual ~RecordedShow() = default;
  virtual const anatomy::Patient& patient() const = 0;
  virtual double length_s() const = 0;
  virtual const std::vector<replay::StripMark>& marks() const = 0;
  /// Where a needle went, for pictures beside (needleTrack); null where none is shown.
  virtual nlohmann::json track() const { return nullptr; }
  virtual bool pictures() const { return false; }    ///< of the camera, beside
  virtual bool fixedViews() const { return false; }  ///< as the session had them
  virtual void hideMap() {}                          ///< of what is felt, where there is one
  /// The view and this outlive it.
  virtual std::unique_ptr<replay::TrialReplay> on(scene::SceneView& view) = 0;
};

/// Of any task. `number` 0: the first that was finished. Throws UsageError for a trial that is not
/// there; Error for a damaged file.
std::unique_ptr<RecordedShow> recordedShow(const std::filesystem::path& file, int number);

/// A needle's, with its near misses as marks, too.
struct RecordedNeedleTrial final : RecordedShow {
  RecordedNeedleTrial(const std::filesystem::path& file, int number);
  const anatomy::Patient& patient() const override { return session.patient(); }
  double length_s() const override { return trial.length_s(); }
  const std::vector<replay::StripMark>& marks() const override { return trial.marks; }
  nlohmann::json track() const override { return way; }
  bool pictures() const override { return !films.empty(); }
  bool fixedViews() const override { return true; }
  std::unique_ptr<replay::TrialReplay> on(scene::SceneView& view) override {
    return replay::needleReplay(trial, view, &films);
  }

  RecordedSession session;
  replay::NeedleTrial trial;
  nlohmann::json way;
  replay::RecordedPictures films;  ///< of the camera, where they lie beside the file
};

/// Which of a session's trials. Throws UsageError where it is not there.
const record::RecordedTrial& chosenTrial(const std::vector<record::RecordedTrial>& trials,
                                         const std::filesystem::path& file, int number);

/// A trial of a palpation, a search or a comparison, ready to be shown. `engine`: of the recorded
/// task. Throws as recordedShow.
std::unique_ptr<RecordedShow> recordedTouch(const std::filesystem::path& file,
                                            training::Engine engine, int number);

}  // namespace palpa::evidence
