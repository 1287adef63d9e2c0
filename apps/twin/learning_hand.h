#pragma once

#include <functional>
#include <memory>

#include "apps/twin/feeling_hands.h"
#include "apps/twin/hand.h"
#include "apps/twin/operator.h"

namespace palpa::twin {

/// Every figure on the line between two persons': level 0 the first's, 1 the second's; counts to
/// the nearest whole number.
OperatorSkill between(const OperatorSkill& from, const OperatorSkill& to, double level);
SearchingSkill between(const SearchingSkill& from, const SearchingSkill& to, double level);

/// Somebody whose skill changes from trial to trial: when a trial begins on the screen, whoever
/// `make` gives for it takes the tool where it is.
class LearningHand final : public Hand {
 public:
  using Make = std::function<std::unique_ptr<Hand>(int trial)>;
  explicit LearningHand(Make make);

  Action act(const Senses& senses, double dt) override;
  const HandGrip& grip() const override { return now_->grip(); }

 private:
  Make make_;
  int trial_ = 1;
  std::unique_ptr<Hand> now_;
};

}  // namespace palpa::twin
