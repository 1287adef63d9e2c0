#pragma once

#include <cstddef>
#include <memory>
#include <utility>
#include <vector>

#include "apps/twin/hand.h"

namespace palpa::twin {

/// One finger of a person with several, each at a device of its own: the same mind behind all of
/// them acts for this one by its number,
///     Hand::Action act(std::size_t finger, const Hand::Senses& senses, double dt)
template <class Mind>
class FingerOf final : public Hand {
 public:
  FingerOf(std::shared_ptr<Mind> mind, const HandGrip& grip, std::size_t finger)
      : mind_(std::move(mind)), grip_(grip), finger_(finger) {}
  Action act(const Senses& senses, double dt) override { return mind_->act(finger_, senses, dt); }
  const HandGrip& grip() const override { return grip_; }

 private:
  std::shared_ptr<Mind> mind_;
  HandGrip grip_;
  std::size_t finger_;
};

template <class Mind>
std::vector<std::unique_ptr<Hand>> fingersOf(const std::shared_ptr<Mind>& mind,
                                             const HandGrip& grip, std::size_t fingers) {
  std::vector<std::unique_ptr<Hand>> all;
  for (std::size_t i = 0; i < fingers; ++i)
    all.push_back(std::make_unique<FingerOf<Mind>>(mind, grip, i));
  return all;
}

}  // namespace palpa::twin
