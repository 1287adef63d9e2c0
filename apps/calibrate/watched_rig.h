#pragma once

#include <functional>
#include <utility>

#include "apps/runtime/rig.h"

namespace palpa::calibrate {

/// A rig whose pictures somebody else sees, too, as they are taken.
class WatchedRig final : public runtime::Rig {
 public:
  using See = std::function<void(const ar::Frame&)>;
  WatchedRig(runtime::Rig& rig, See see) : rig_(rig), see_(std::move(see)) {}

  void ask(const runtime::Request& request) override { rig_.ask(request); }
  std::optional<runtime::Moment> next() override {
    std::optional<runtime::Moment> moment = rig_.next();
    if (moment && moment->picture)
      moment->picture = [this, take = std::move(moment->picture)] {
        std::optional<ar::Frame> frame = take();
        if (frame) see_(*frame);
        return frame;
      };
    return moment;
  }

 private:
  runtime::Rig& rig_;
  const See see_;
};

}  // namespace palpa::calibrate
