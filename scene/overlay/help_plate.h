#pragma once

#include <memory>
#include <vector>

#include "scene/overlay/label.h"
#include "scene/panels.h"
#include "scene/scene_state.h"

class vtkRenderer;

namespace palpa::scene {

/// The keys of a session and what they do, in the middle of the view, over all that is there.
class HelpPlate {
 public:
  explicit HelpPlate(vtkRenderer& renderer);  ///< the renderer covers the whole window
  ~HelpPlate();

  /// Laid out again only when something changed; nothing is drawn without a row. Rows that have no
  /// room at the smallest text are left out from the end.
  void update(const std::vector<KeyHelp>& keys, const Rect& panel, int text_px);

 private:
  void build();
  void write(const std::string& text, const TextStyle& style, int x, int y, Align align);

  Plates plates_;
  vtkRenderer& renderer_;
  std::vector<std::unique_ptr<Label>> labels_;
  std::size_t used_ = 0;
  std::vector<KeyHelp> keys_;
  Rect panel_;
  int text_px_ = 0;
};

}  // namespace palpa::scene
