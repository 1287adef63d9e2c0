#pragma once

#include <vtkNew.h>

#include <optional>
#include <span>
#include <string>

#include "scene/palette.h"
#include "scene/panels.h"

class vtkActor2D;
class vtkPolyData;
class vtkRenderer;

namespace palpa::scene {

/// Flat coloured rectangles with round corners, drawn under the text of a renderer: what makes
/// words legible on any picture. All of them are one draw call.
class Plates {
 public:
  explicit Plates(vtkRenderer& renderer);
  ~Plates();

  void clear();
  void setVisible(bool visible);
  void add(const Rect& where, const Rgba& colour, int corner_px);

 private:
  vtkNew<vtkPolyData> shapes_;
  vtkNew<vtkActor2D> actor_;
};

}  // namespace palpa::scene

class vtkRenderer;
class vtkTextActor;
class vtkTextProperty;

namespace palpa::scene {

inline constexpr int kSmallestText_px = 11;  ///< smaller text is not drawn

struct TextStyle {
  int size_px = 14;
  bool bold = false;
  Rgb colour = colour::kText;
};

/// In the font that has the text's letters, when the machine has it (anatomy/base/fonts.h; VTK's
/// own fonts lack Greek and many accents).
void apply(const TextStyle& style, const std::string& text, vtkTextProperty& property);

int textWidth(const std::string& text, const TextStyle& style);  ///< pixels
int lineHeight(const TextStyle& style);                          ///< pixels, one line

enum class Align { left, centre, right };

/// Of a picture: a length to compare with.
struct ScaleBar {
  int mm = 0, px = 0;
};
/// The first of these lengths that takes no more than `longest_px`; nothing where none does.
std::optional<ScaleBar> scaleBar(std::span<const int> lengths_mm, double metres_a_pixel,
                                 double longest_px);

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
