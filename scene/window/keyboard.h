#pragma once

#include <memory>
#include <string>
#include <vector>

#include "scene/key_places.h"

namespace palpa::scene {

struct PressedKey {
  std::string name;   ///< of its place ("t"); of a key without one, and of "?", what it types
  std::string typed;  ///< in the layout that is on: X's symbol, e.g. "Greek_tau", "plus"
};

/// The keys over a window, on a connection of its own to the X server: VTK passes on what a key
/// types, and not which key it was. Heeds a layout that is switched meanwhile. A server that is
/// gone, or a window, says nothing any more.
class Keyboard {
 public:
  /// `window`: the window's number at the server that DISPLAY names.
  explicit Keyboard(unsigned long window);
  ~Keyboard();
  Keyboard(const Keyboard&) = delete;
  Keyboard& operator=(const Keyboard&) = delete;

  std::vector<PressedKey> pressed();  ///< since the last call; never waits for a key
  const KeyPrints& prints() const;    ///< of the layout that was on at the last call of pressed()

 private:
  struct Connection;
  std::unique_ptr<Connection> connection_;
};

}  // namespace palpa::scene
