#include "apps/doctor/picture_facts.h"

#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>

#include "anatomy/base/error.h"
#include "anatomy/base/quantile.h"
#include "apps/doctor/finding.h"
#include "ar/tracking/board_pose.h"

namespace palpa::doctor {
namespace {

constexpr double kDark = 110, kBurnt = 0.15;  // the brightest hundredth; share of pixels
constexpr double kBlurred_px = 3.5;           // edges of a sharp picture are 2 to 3 pixels wide
constexpr double kPoorFit_px = 1.5;  // of the board's points: another board, or another camera
constexpr double kSlow = 0.8;        // of the rate that is asked for
constexpr double kOftenSeen = 0.8;

/// Level below which this share of the pixels lies.
double levelOf(const cv::Mat& gray, double share) {
  std::array<int, 256> count{};
  for (int v = 0; v < gray.rows; ++v)
    for (const std::uint8_t* p = gray.ptr(v); p != gray.ptr(v) + gray.cols; ++p) ++count[*p];
  double left = share * static_cast<double>(gray.total());
  int level = 0;
  while (level < 255 && (left -= count[static_cast<std::size_t>(level)]) > 0) ++level;
  return level;
}

/// Contrast over the steepest slopes, as the width from 10 % to 90 % of a straight edge.
double edgeWidth(const cv::Mat& gray) {
  cv::Mat smooth, dx, dy, slope, whole;
  cv::GaussianBlur(gray, smooth, {3, 3}, 0);  // noise is no edge
  cv::Sobel(smooth, dx, CV_32F, 1, 0, 3, 0.125);
  cv::Sobel(smooth, dy, CV_32F, 0, 1, 3, 0.125);
  cv::magnitude(dx, dy, slope);
  slope.convertTo(whole, CV_8U);
  const double steepest = levelOf(whole, 0.98),
               contrast = levelOf(gray, 0.95) - levelOf(gray, 0.05);
  return steepest > 0 ? 0.8 * contrast / steepest : 1e9;
}

cv::Rect around(const std::vector<ar::BoardPoint>& points, const cv::Size& size) {
  double low_u = size.width, low_v = size.height, high_u = 0, high_v = 0;
  for (const ar::BoardPoint& point : points) {
    low_u = std::min(low_u, point.pixel.x());
    high_u = std::max(high_u, point.pixel.x());
    low_v = std::min(low_v, point.pixel.y());
    high_v = std::max(high_v, point.pixel.y());
  }
  return cv::Rect(cv::Point(static_cast<int>(low_u), static_cast<int>(low_v)),
                  cv::Point(static_cast<int>(high_u) + 1, static_cast<int>(high_v) + 1)) &
         cv::Rect({0, 0}, size);
}

/// One picture after the other.
class Looker {
 public:
  Looker(const ar::Board& board, const calibration::CameraModel& camera,
         const runtime::Clock* clock)
      : board_(board), camera_(camera), clock_(clock) {}

  void look(const ar::Frame& frame) {
    lookAtTime(frame.t_exposure_ns);
    facts_.seconds = 1e-9 * static_cast<double>(frame.t_exposure_ns - first_ns_);
    if (frame.image.cols != camera_.width || frame.image.rows != camera_.height) {
      ++facts_.wrong_size;
      return;
    }
    cv::Mat gray = frame.image;
    if (gray.channels() == 3) cv::cvtColor(frame.image, gray, cv::COLOR_BGR2GRAY);
    if (!last_.empty() && cv::norm(gray, last_, cv::NORM_INF) == 0) ++facts_.alike;
    last_ = gray.clone();
    bright_.push_back(levelOf(gray, 0.99));
    burnt_.push_back(static_cast<double>(cv::countNonZero(gray >= 250)) /
                     static_cast<double>(gray.total()));
    findBoard(gray);
  }

  PictureFacts facts() {
    const auto mean = [](const std::vector<double>& v) {
      double sum = 0;
      for (const double x : v) sum += x;
      return v.empty() ? 0 : sum / static_cast<double>(v.size());
    };
    facts_.bright = mean(bright_);
    facts_.burnt = mean(burnt_);
    facts_.edge_px = upperMedian(edges_);
    facts_.rms_px = upperMedian(rms_);
    return facts_;
  }

 private:
  void lookAtTime(std::int64_t exposed_ns) {
    constexpr std::int64_t kOldest = 2 * runtime::kSecond;  // as a session has it
    if (facts_.pictures++ == 0)
      first_ns_ = exposed_ns;
    else if (exposed_ns <= last_ns_)
      ++facts_.backward;
    last_ns_ = exposed_ns;
    if (!clock_) return;
    const std::int64_t now = clock_->now(), stamped = clock_->ofMonotonic(exposed_ns);
    if (stamped > now || stamped <= now - kOldest) ++facts_.undated;
  }

  void findBoard(const cv::Mat& gray) {
    const std::vector<ar::BoardPoint> points = board_.detect(gray);
    if (static_cast<int>(points.size()) < board_.leastPoints()) return;
    const auto pose = ar::estimateBoardPose(points, camera_);
    if (!pose) return;
    ++facts_.seen;
    rms_.push_back(pose->rms_px);
    const cv::Rect region = around(points, gray.size());
    if (region.area() > 400) edges_.push_back(edgeWidth(gray(region)));
  }

  const ar::Board& board_;
  const calibration::CameraModel& camera_;
  PictureFacts facts_;
  const runtime::Clock* clock_;
  std::int64_t first_ns_ = 0, last_ns_ = 0;
  cv::Mat last_;
  std::vector<double> bright_, burnt_, edges_, rms_;
};

Finding judgeCamera(const PictureFacts& f, double rate_Hz, const calibration::CameraModel& camera) {
  const auto ill = [](std::string verdict, std::string fix) {
    return Finding{"camera", State::ill, std::move(verdict), std::move(fix)};
  };
  if (!f.trouble.empty()) return troubled("camera", State::ill, f.trouble);
  if (f.pictures < 2)
    return ill("gives no pictures", "Plug its cable in again; see that no other program uses it");
  if (f.wrong_size > 0)
    return ill(text("does not give pictures of %d x %d pixels", camera.width, camera.height),
               "Calibrate this camera (palpa calibrate camera), or set it to the size that the "
               "station's file names");
  if (2 * f.alike > f.pictures)
    return ill("gives the same picture over and over", "Unplug the camera and plug it in again");
  if (f.bright < kDark)
    return ill(
        text("pictures are too dark (the brightest hundredth is at %.0f of 255)", f.bright),
        "Take the cap off, switch a lamp on, or raise camera/exposure_ms in the station's file");
  if (f.burnt > kBurnt)
    return ill(text("pictures are too bright (%.0f %% of them is white)", 100 * f.burnt),
               "Turn the lamp away, or lower camera/exposure_ms in the station's file");
  const double rate = f.seconds > 0 ? (f.pictures - 1) / f.seconds : 0;
  if (f.seen > 0 && f.edge_px > kBlurred_px)
    return {"camera", State::note,
            text("pictures are out of focus (edges are %.1f pixels wide)", f.edge_px),
            "Turn the lens's focus, or set camera/focus in the station's file; then calibrate the "
            "camera again"};
  if (rate < kSlow * rate_Hz)
    return {"camera", State::note,
            text("gives %.1f pictures a second where %.1f are asked for", rate, rate_Hz),
            "Give it a USB port of its own and more light (a dark room makes exposures long)"};
  if (!f.remark.empty())
    return {"camera", State::note, f.remark,
            "Use a camera whose exposure, focus and white balance can be fixed; with this one keep "
            "the light as it was at its calibration"};
  return {"camera", State::well,
          text("%.1f pictures a second, exposure right", rate) +
              (f.seen > 0 ? text(", edges %.1f pixels wide", f.edge_px) : "")};
}

Finding judgeBoard(const PictureFacts& f) {
  const int fit = f.pictures - f.wrong_size;
  if (fit < 1)
    return {"board", State::ill, "cannot be looked for: there are no pictures",
            "See to the camera first"};
  if (f.seen == 0)
    return {"board", State::ill, "is not seen",
            "Put the printed board flat under the camera, all of it in the picture, nothing on it, "
            "the lens in focus. None printed? palpa board print"};
  if (f.rms_px > kPoorFit_px)
    return {"board", State::ill, text("does not fit (its points are off by %.1f pixels)", f.rms_px),
            "Is it the board that the station's file describes, flat and undamaged? Else calibrate "
            "the camera again"};
  if (f.seen < kOftenSeen * fit)
    return {"board", State::note, text("is seen in %d of %d pictures only", f.seen, fit),
            "Move what hides it, and lamps that shine on it"};
  return {"board", State::well,
          text("seen in %d of %d pictures, its points within %.2f pixels", f.seen, fit, f.rms_px)};
}

}  // namespace

PictureFacts lookAt(const std::function<std::optional<ar::Frame>()>& grab, int count,
                    const ar::Board& board, const calibration::CameraModel& camera,
                    const runtime::Clock* clock) {
  Looker looker(board, camera, clock);
  try {
    for (int i = 0; i < count; ++i) {
      const std::optional<ar::Frame> frame = grab();
      if (!frame) break;
      looker.look(*frame);
    }
    return looker.facts();
  } catch (const Error& e) {
    PictureFacts facts = looker.facts();
    facts.trouble = e.what();
    return facts;
  }
}

Findings judgePictures(const PictureFacts& facts, double rate_Hz,
                       const calibration::CameraModel& camera) {
  return {judgeCamera(facts, rate_Hz, camera), judgeBoard(facts)};
}

}  // namespace palpa::doctor
