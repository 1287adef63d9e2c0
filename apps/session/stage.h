#pragma once

#include <memory>
#include <string>
#include <vector>

#include "apps/headset/headset_view.h"
#include "apps/runtime/executive.h"
#include "apps/session/session_devices.h"
#include "apps/session/session_options.h"
#include "scene/view/scene_view.h"

namespace palpa::session {

/// What the session is shown on; the view goes before its context.
struct DesktopStage {
  std::unique_ptr<scene::GlContextProvider> context;
  std::unique_ptr<scene::SceneView> view;
  std::string renderer = {};  ///< of a window: what draws, as OpenGL names it
};

/// Where a window is to be: as it was asked for, else as it was left last, else four fifths of the
/// primary monitor. Throws UsageError for a monitor that was asked for and is not there.
scene::WindowPlace placeOfWindow(const scene::WindowPlace& asked);
/// For the next one; a preference: where it cannot be kept, it is forgotten.
void rememberWindow(const scene::WindowPlace& now);

DesktopStage makeStage(const SessionOptions& options, const anatomy::Patient& patient, bool window,
                       bool fixed_views = true);

/// The headset, where one was asked for and is there.
struct HeadStage {
  std::unique_ptr<headset::HeadsetView> view;  ///< null: none
  std::string refusal;                         ///< why not

  report::Fact fact() const;  ///< for the report
};

/// How steadily it drew, and what: of a session in real time, before a window; else nothing.
std::vector<report::Fact> drawingFacts(const std::string& renderer,
                                       const std::vector<runtime::Lateness>& lateness);

/// Without a headset the session goes on on the desktop, and standard error says so; throws only
/// where a person then has nothing to see. The desktop's window decides the kind of context, and
/// does not wait for its monitor any more.
HeadStage makeHeadStage(const SessionOptions& options, const anatomy::Patient& patient,
                        const Pose& X_WA, const DesktopStage& desktop);

}  // namespace palpa::session
