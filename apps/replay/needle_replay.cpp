#include "apps/replay/needle_replay.h"

#include <algorithm>
#include <string>

#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>

#include "anatomy/base/film_table.h"
#include "apps/replay/trial_replay.h"
#include "apps/task_needle/needle_scene.h"
#include "ar/codecs/codecs.h"

namespace palpa::replay {

MomentReader::MomentReader(const Pose& X_AD, const PackedPose& X_ET, int trial)
    : X_ET_(unpack(X_ET)), sampler_(X_AD, X_ET) {
  sampler_.begin(static_cast<std::uint32_t>(trial));
}

void MomentReader::add(const haptics::FlightRecord& record) {
  assess::TrialSample sample;
  if (!sampler_.add(record, &sample)) return;
  phases_.add(sample);
  const Tissue flows = assess::aspiratedFrom(sample, rules_);
  syringe_.add(sample, flows, last_s_);
  last_s_ = sample.t_s;
  if (!moments_.empty() && sample.t_s - moments_.back().t_s < kMomentStep - 1e-9) return;
  moments_.push_back({sample.t_s, toolIn(record, X_ET_), phases_.phase(), syringe_.blood(),
                      syringe_.of(), flows, record.commands.asked != 0});
}

task_needle::TaskStatus statusAt(const NeedleMoment& moment, int trial, bool force_feedback) {
  task_needle::TaskStatus status;
  status.state = trial::TrialState::running;
  status.trial = trial;
  status.trials = 1;
  status.force_feedback = force_feedback;
  status.elapsed_s = moment.t_s;
  status.phase = moment.phase;
  status.step = assess::clinicalName(moment.phase);
  status.plunger = moment.tool.plunger;
  status.blood = moment.blood;
  status.holds = moment.holds;
  status.flows = moment.flows;
  status.asked = moment.asked;
  return status;
}

namespace {

// JPEG's start of image; a byte 0xff in the data is followed by 0 (ITU T.81, B.1.1.5)
constexpr unsigned char kEscape = 0xff, kBegin = 0xd8;

}  // namespace

RecordedPictures::RecordedPictures(const std::filesystem::path& folder)
    : film_(folder / "camera.mjpeg", std::ios::binary) {
  if (!film_) return;
  findPictures();
  for (const FilmPicture& picture : filmTable(folder / "camera.mjpeg"))
    times_ns_.push_back(picture.t_ns);
  times_ns_.resize(std::min(times_ns_.size(), begins_.size() - 1));
}

void RecordedPictures::findPictures() {
  std::vector<char> block(1 << 16);
  std::streamoff at = 0;
  unsigned char before = 0;
  while (film_.read(block.data(), static_cast<std::streamsize>(block.size())), film_.gcount() > 0) {
    for (std::streamsize i = 0; i < film_.gcount(); ++i) {
      const auto byte = static_cast<unsigned char>(block[static_cast<std::size_t>(i)]);
      if (before == kEscape && byte == kBegin) begins_.push_back(at + i - 1);
      before = byte;
    }
    at += film_.gcount();
  }
  begins_.push_back(at);
  film_.clear();
}

void RecordedPictures::read(std::size_t number) {
  shown_ = number;
  std::vector<char> jpeg(static_cast<std::size_t>(begins_[number + 1] - begins_[number]));
  film_.seekg(begins_[number]);
  film_.read(jpeg.data(), static_cast<std::streamsize>(jpeg.size()));
  film_.clear();
  const cv::Mat picture = ar::decode(jpeg, cv::IMREAD_COLOR);
  if (picture.empty()) return;
  cv::Mat rgb;
  cv::cvtColor(picture, rgb, cv::COLOR_BGR2RGB);
  image_ = {rgb.cols, rgb.rows, 3, {}};
  image_.pixels.assign(rgb.data, rgb.data + rgb.total() * 3);
}

const scene::Image* RecordedPictures::at(std::int64_t t_ns) {
  const auto after = std::upper_bound(times_ns_.begin(), times_ns_.end(), t_ns);
  if (after == times_ns_.begin()) return nullptr;
  const auto number = static_cast<std::size_t>(after - times_ns_.begin()) - 1;
  if (number != shown_) read(number);
  return image_.pixels.empty() ? nullptr : &image_;
}

namespace {

constexpr double kTrailPoint = 0.0005;  // m between points of the trail

class NeedleReplay final : public TrialReplay {
 public:
  NeedleReplay(const NeedleTrial& trial, scene::SceneView& view, RecordedPictures* pictures)
      : TrialReplay(trial, trial.length_s()),
        recorded_(trial),
        pictures_(pictures),
        scene_(setup(view), bus_, channels_) {
    Vec3 last = Vec3::Constant(1e9);
    for (const NeedleMoment& moment : recorded_.moments) {
      const Vec3 tip = recorded_.X_AD * unpack(moment.tool.X_DT).translation();
      if (moment.tool.phase != haptics::NeedlePhase::outside && (tip - last).norm() > kTrailPoint)
        trail_.push_back(last = tip);
      trail_length_.push_back(trail_.size());
    }
  }

 private:
  task_needle::NeedleSceneSetup setup(scene::SceneView& view) {
    task_needle::NeedleSceneSetup s;
    s.stage = stage(view);
    s.words = recorded_.words;
    return s;
  }

  void showAt(double t_s, std::int64_t now_ns) override {
    const NeedleMoment& moment = recorded_.moments[momentAt(recorded_.moments, t_s)];
    bus_.haptic_to_scene.publish(moment.tool, now_ns);
    task_needle::TaskStatus status = statusAt(moment, recorded_.number, recorded_.force_feedback);
    status.elapsed_s = t_s;  // as the strip says it
    channels_.status_to_scene.publish(status, now_ns);
  }

  trial::TrialScene& scene() override { return scene_; }

  /// The way so far, whichever way one came here.
  void add(scene::SceneState& state, double at_s) override {
    const std::size_t i = momentAt(recorded_.moments, at_s);
    state.trail_A.assign(trail_.begin(),
                         trail_.begin() + static_cast<std::ptrdiff_t>(trail_length_[i]));
    state.beside = pictures_ ? pictures_->at(recorded_.moments[i].tool.t_ns) : nullptr;
  }

  const NeedleTrial& recorded_;
  RecordedPictures* pictures_;
  std::vector<Vec3> trail_;
  std::vector<std::size_t> trail_length_;  ///< up to each moment
  task_needle::TaskChannels channels_{runtime::TimeMode::virtual_time};
  task_needle::NeedleScene scene_;
};

}  // namespace

std::unique_ptr<TrialReplay> needleReplay(const NeedleTrial& trial, scene::SceneView& view,
                                          RecordedPictures* pictures) {
  return std::make_unique<NeedleReplay>(trial, view, pictures);
}

}  // namespace palpa::replay
