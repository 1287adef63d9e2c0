#include <opencv2/imgproc.hpp>

#include "apps/doctor/computer_check.h"
#include "apps/doctor/picture_facts.h"
#include "apps/twin/bench_faults.h"
#include "apps/twin/setup_bench.h"
#include "says.h"

namespace palpa::doctor {
namespace {

/// The bench's pictures, spoilt by `change`; taken once for all tests.
Findings lookedAt(const std::function<std::optional<ar::Frame>(ar::Frame)>& change,
                  int count = 12) {
  static const std::vector<ar::Frame> frames = [] {
    twin::SetupBench bench(benchStation(), 3);
    std::vector<ar::Frame> taken;
    while (taken.size() < 12)
      if (const auto moment = bench.next(); moment && moment->picture)
        if (auto frame = moment->picture()) taken.push_back(*frame);
    return taken;
  }();
  const station::Station& s = benchStation();
  const auto board = ar::makeBoard(s.board, s.decimate);
  std::size_t next = 0;
  const auto grab = [&]() -> std::optional<ar::Frame> {
    if (next == frames.size()) return std::nullopt;
    ar::Frame frame = frames[next++];
    frame.image = frame.image.clone();
    return change(frame);
  };
  return judgePictures(lookAt(grab, count, *board, s.camera), s.camera_rate_Hz, s.camera);
}

Findings spoiltBy(twin::CameraFaultKind kind) {
  return lookedAt([kind](ar::Frame frame) {
    return twin::spoilt(std::move(frame), {kind, 0, 1e9});
  });
}

TEST(DoctorsPictures, OfAHealthyBenchAreWell) {
  for (const Finding& finding : lookedAt([](ar::Frame frame) { return std::optional(frame); })) {
    EXPECT_EQ(finding.state, State::well) << finding.subject << ": " << finding.verdict;
    RecordProperty(finding.subject, finding.verdict);
  }
}

TEST(DoctorsPictures, EveryFaultIsNamed) {
  using twin::CameraFaultKind;
  expectSays(spoiltBy(CameraFaultKind::black)[0], State::ill, "too dark");
  expectSays(spoiltBy(CameraFaultKind::wrong_size)[0], State::ill, "does not give pictures of");
  expectSays(spoiltBy(CameraFaultKind::ended)[0], State::ill, "no pictures");
  EXPECT_EQ(spoiltBy(CameraFaultKind::gone)[0].state, State::ill);
  expectSays(spoiltBy(CameraFaultKind::hidden)[1], State::ill, "is not seen");
  std::optional<ar::Frame> first;
  expectSays(lookedAt([&first](ar::Frame frame) {
               if (!first) first = frame;
               frame.image = first->image;
               return std::optional(frame);
             })[0],
             State::ill, "same picture");
  expectSays(lookedAt([](ar::Frame frame) {
               frame.image.convertTo(frame.image, -1, 1, 140);
               return std::optional(frame);
             })[0],
             State::ill, "too bright");
  expectSays(lookedAt([](ar::Frame frame) {
               cv::GaussianBlur(frame.image, frame.image, {}, 1.5);
               return std::optional(frame);
             })[0],
             State::note, "out of focus");
  expectSays(lookedAt([](ar::Frame frame) {
               frame.t_exposure_ns *= 3;
               return std::optional(frame);
             })[0],
             State::note, "pictures a second where");
  int n = 0;
  expectSays(lookedAt([&n](ar::Frame frame) {
               if (n++ % 2) frame.image.setTo(128);
               return std::optional(frame);
             })[1],
             State::note, "in 6 of 12 pictures only");
}

/// Another lens than the station's file says.
TEST(DoctorsPictures, AForeignCameraDoesNotFit) {
  const Findings found = lookedAt([](ar::Frame frame) {
    cv::Mat middle = frame.image.clone();
    for (int v = 0; v < middle.rows; ++v)  // bends what is straight
      cv::remap(
          frame.image.rowRange(v, v + 1), middle.rowRange(v, v + 1),
          [&] {
            cv::Mat x(1, middle.cols, CV_32F);
            for (int u = 0; u < middle.cols; ++u)
              x.at<float>(0, u) =
                  static_cast<float>(u) + 8.F * static_cast<float>(std::sin(0.02 * v + 0.01 * u));
            return x;
          }(),
          cv::Mat::zeros(1, middle.cols, CV_32F), cv::INTER_LINEAR);
    frame.image = middle;
    return std::optional(frame);
  });
  EXPECT_NE(found[1].state, State::well) << found[1].verdict;
}

/// A real camera dates its pictures by the computer's clock; pictures that go back or come from
/// elsewhere are told.
TEST(DoctorsPictures, TimesThatCannotBeAreNamed) {
  const station::Station& s = benchStation();
  const auto board = ar::makeBoard(s.board, s.decimate);
  const runtime::SteadyClock clock;
  const std::int64_t start = -clock.ofMonotonic(0);  // of CLOCK_MONOTONIC
  const auto seen = [&](const std::function<std::int64_t(int)>& stamp) {
    int n = 0;
    const auto grab = [&]() -> std::optional<ar::Frame> {
      return ar::Frame{static_cast<std::uint64_t>(n), stamp(n++),
                       cv::Mat(480, 640, CV_8UC1, cv::Scalar(128)), "test"};
    };
    return judgeClocks({}, lookAt(grab, 5, *board, s.camera, &clock), false);
  };
  runtime::SteadyClock().sleepUntil(10 * runtime::kMillisecond);
  expectSays(seen([&](int n) { return start + n * runtime::kMillisecond; }), State::well, "date");
  expectSays(seen([&](int n) { return start + (n == 3 ? 0 : n * runtime::kMillisecond); }),
             State::note, "go back in 1 of 5");
  expectSays(seen([&](int n) { return start - 100 * runtime::kSecond + n; }), State::note,
             "5 of 5 pictures by another clock");
  expectSays(seen([&](int n) { return start + 900 * runtime::kSecond + n; }), State::note,
             "5 of 5 pictures by another clock");
}

TEST(DoctorsPictures, WhatACameraDoesNotLetBeFixedIsNamed) {
  PictureFacts facts;
  facts.pictures = facts.seen = 10, facts.seconds = 0.6, facts.bright = 200, facts.edge_px = 2;
  facts.remark = "the camera does not let its exposure be fixed";
  expectSays(judgePictures(facts, 15, benchStation().camera)[0], State::note, "exposure be fixed");
}

}  // namespace
}  // namespace palpa::doctor
