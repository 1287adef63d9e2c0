#pragma once

#include <memory>
#include <string>

#include "apps/cli/needle_world.h"
#include "apps/cli/session_devices.h"
#include "apps/cli/stage.h"
#include "apps/headset/headset_view.h"

namespace palpa::cli {

/// The headset, where one was asked for and is there.
struct HeadStage {
  std::unique_ptr<headset::HeadsetView> view;  ///< null: none
  std::string refusal;                         ///< why not

  SessionDevices::Fact fact() const;  ///< for the report
};

/// Without a headset the session goes on on the desktop, and standard error says so; throws only
/// where a person then has nothing to see. The desktop's window decides the kind of context, and
/// does not wait for its monitor any more.
HeadStage makeHeadStage(const SessionOptions& options, const NeedleWorld& world,
                        const Stage& desktop);

}  // namespace palpa::cli
