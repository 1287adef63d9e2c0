#include "scene/overlay/label.h"

#include <vtkActor2D.h>
#include <vtkCellArray.h>
#include <vtkCellData.h>
#include <vtkCoordinate.h>
#include <vtkPoints.h>
#include <vtkPolyData.h>
#include <vtkPolyDataMapper2D.h>
#include <vtkProperty2D.h>
#include <vtkRenderer.h>
#include <vtkStdString.h>
#include <vtkTextActor.h>
#include <vtkTextProperty.h>
#include <vtkTextRenderer.h>
#include <vtkUnsignedCharArray.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>

#include "anatomy/base/fonts.h"
#include "scene/scene_state.h"

namespace palpa::scene {

Plates::Plates(vtkRenderer& renderer) {
  vtkNew<vtkCoordinate> pixels;
  pixels->SetCoordinateSystemToViewport();
  vtkNew<vtkPolyDataMapper2D> mapper;
  mapper->SetInputData(shapes_);
  mapper->SetTransformCoordinate(pixels);
  mapper->SetScalarModeToUseCellData();
  actor_->SetMapper(mapper);
  actor_->SetLayerNumber(0);
  renderer.AddActor2D(actor_);
  clear();
}

Plates::~Plates() = default;

void Plates::clear() {
  vtkNew<vtkPoints> points;
  vtkNew<vtkCellArray> polygons;
  vtkNew<vtkUnsignedCharArray> colours;
  colours->SetNumberOfComponents(4);
  shapes_->SetPoints(points);
  shapes_->SetPolys(polygons);
  shapes_->GetCellData()->SetScalars(colours);
}

void Plates::setVisible(bool visible) { actor_->SetVisibility(visible); }

void Plates::add(const Rect& where, const Rgba& colour, int corner_px) {
  constexpr int kSteps = 5;
  const double r = std::min({corner_px, where.width / 2, where.height / 2});
  const double centres[4][2] = {{where.right() - r, where.top() - r},
                                {where.x + r, where.top() - r},
                                {where.x + r, where.y + r},
                                {where.right() - r, where.y + r}};
  vtkCellArray* polygons = shapes_->GetPolys();
  polygons->InsertNextCell(4 * (kSteps + 1));
  for (int corner = 0; corner < 4; ++corner) {
    for (int i = 0; i <= kSteps; ++i) {
      const double angle = 0.5 * std::numbers::pi * (corner + static_cast<double>(i) / kSteps);
      polygons->InsertCellPoint(shapes_->GetPoints()->InsertNextPoint(
          centres[corner][0] + r * std::cos(angle), centres[corner][1] + r * std::sin(angle), 0));
    }
  }
  auto* colours = vtkUnsignedCharArray::SafeDownCast(shapes_->GetCellData()->GetScalars());
  colours->InsertNextTuple4(255 * colour[0], 255 * colour[1], 255 * colour[2], 255 * colour[3]);
  shapes_->GetPoints()->Modified();
  shapes_->Modified();
}

namespace {

constexpr std::size_t kRemembered = 500;  // texts: most stand for many frames

thread_local std::map<std::string, std::string> known;
Wording& ofProcess() {
  static Wording wording;
  return wording;
}

}  // namespace

void sayThrough(Wording wording) { ofProcess() = std::move(wording); }

std::string said(const std::string& english) {
  if (!ofProcess() || english.empty()) return english;
  if (const auto found = known.find(english); found != known.end()) return found->second;
  if (known.size() > kRemembered) known.clear();
  return known[english] = ofProcess()(english);
}

namespace {

constexpr int kDpi = 72;  // makes a font's points pixels

/// Null: the machine lacks it.
const char* fontFile(const std::string& text, bool bold) {
  static std::map<const Font*, bool> there;
  const Font& font = fontOf(text);
  const auto [found, is_new] = there.try_emplace(&font);
  if (is_new) found->second = isThere(font);
  if (!found->second) return nullptr;
  return bold ? font.bold : font.plain;
}

std::array<int, 4> bounds(const std::string& text, const TextStyle& style) {
  vtkNew<vtkTextProperty> property;
  apply(style, text, *property);
  std::array<int, 4> box{};
  vtkTextRenderer::GetInstance()->GetBoundingBox(property, text, box.data(), kDpi);
  return box;
}

}  // namespace

void apply(const TextStyle& style, const std::string& text, vtkTextProperty& property) {
  if (const char* file = fontFile(text, style.bold)) {
    property.SetFontFamily(VTK_FONT_FILE);
    property.SetFontFile(file);
  } else {
    property.SetFontFamilyToArial();
    property.SetBold(style.bold);
  }
  property.SetFontSize(style.size_px);
  Rgb colour = style.colour;
  property.SetColor(colour.data());
}

int textWidth(const std::string& text, const TextStyle& style) {
  const auto box = bounds(text, style);
  return box[1] - box[0] + 1;
}

std::optional<ScaleBar> scaleBar(std::span<const int> lengths_mm, double metres_a_pixel,
                                 double longest_px) {
  for (const int mm : lengths_mm)
    if (const auto px = static_cast<int>(std::lround(1e-3 * mm / metres_a_pixel)); px <= longest_px)
      return ScaleBar{mm, px};
  return std::nullopt;
}

int lineHeight(const TextStyle& style) { return style.size_px * 13 / 10; }

Label::Label(vtkRenderer& renderer) : renderer_(renderer) {
  actor_->SetTextScaleModeToNone();
  actor_->GetPositionCoordinate()->SetCoordinateSystemToViewport();
  actor_->GetTextProperty()->SetVerticalJustificationToCentered();
  actor_->VisibilityOff();
  renderer.AddActor2D(actor_);
}

Label::~Label() { renderer_.RemoveActor2D(actor_); }

void Label::set(const std::string& text, const TextStyle& style, int x, int y, Align align) {
  apply(style, text, *actor_->GetTextProperty());
  switch (align) {
    case Align::left:
      actor_->GetTextProperty()->SetJustificationToLeft();
      break;
    case Align::centre:
      actor_->GetTextProperty()->SetJustificationToCentered();
      break;
    case Align::right:
      actor_->GetTextProperty()->SetJustificationToRight();
      break;
  }
  actor_->SetInput(text.c_str());
  actor_->SetPosition(x, y);
  actor_->SetVisibility(!text.empty());
}

void Label::show() { actor_->VisibilityOn(); }
void Label::hide() { actor_->VisibilityOff(); }

}  // namespace palpa::scene
