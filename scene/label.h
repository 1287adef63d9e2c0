#pragma once

#include <vtkNew.h>

#include <string>

#include "scene/palette.h"

class vtkRenderer;
class vtkTextActor;
class vtkTextProperty;

namespace palpa::scene {

struct TextStyle {
  int size_px = 14;
  bool bold = false;
  Rgb colour = colour::kText;
};

/// DejaVu Sans when the machine has it (VTK's own fonts lack Greek and many accents).
void apply(const TextStyle& style, vtkTextProperty& property);

int textWidth(const std::string& text, const TextStyle& style);  ///< pixels
int lineHeight(const TextStyle& style);                          ///< pixels, one line

enum class Align { left, centre, right };

/// One line of text in a renderer; x and y are pixels of its viewport, y the line's middle.
class Label {
 public:
  explicit Label(vtkRenderer& renderer);
  ~Label();
  void set(const std::string& text, const TextStyle& style, int x, int y, Align align);
  void show();
  void hide();

 private:
  vtkRenderer& renderer_;
  vtkNew<vtkTextActor> actor_;
};

}  // namespace palpa::scene
