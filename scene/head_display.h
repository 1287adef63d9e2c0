#pragma once

#include <string>

#include "scene/scene_state.h"

namespace palpa::scene {

/// A display on the head, beside the desktop's view. Used by the thread of the scene alone.
class HeadDisplay {
 public:
  virtual ~HeadDisplay() = default;
  /// Waits until the next frame is to be made. False: there is none, the desktop's view goes on
  /// alone. `may_place`: the patient may be put before the person anew, if they ask for it: not
  /// while the tool is in him.
  virtual bool wait(bool may_place) = 0;
  /// Draws it and shows it; after every wait() that was true. The camera's picture and pose are not
  /// used: the patient lies before the person.
  virtual void show(const SceneState& state) = 0;
  /// In the hand that holds the tool: `strength` 0..1.
  virtual void pulse(double seconds, double strength) = 0;
  virtual std::string trouble() const = 0;  ///< why it has ended, in words; empty: it has not
};

}  // namespace palpa::scene
