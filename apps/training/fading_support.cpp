#include "apps/training/fading_support.h"

#include <algorithm>

namespace palpa::training {
namespace {

constexpr double kLess = 0.34, kMore = 0.17;

}  // namespace

FadingSupport::FadingSupport(bool on, double start)
    : on_(on), amount_(on ? std::clamp(start, 0.0, 1.0) : 0) {}

void FadingSupport::end(bool good) {
  if (on_) amount_ = std::clamp(amount_ + (good ? -kLess : kMore), 0.0, 1.0);
}

}  // namespace palpa::training
