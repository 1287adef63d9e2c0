#include "scene/label.h"

#include <vtkRenderer.h>
#include <vtkStdString.h>
#include <vtkTextActor.h>
#include <vtkTextProperty.h>
#include <vtkTextRenderer.h>

#include <filesystem>

namespace palpa::scene {
namespace {

constexpr int kDpi = 72;  // makes a font's points pixels

const char* fontFile(bool bold) {
  static const char* const plain = "/usr/share/fonts/truetype/dejavu/DejaVuSans.ttf";
  static const char* const heavy = "/usr/share/fonts/truetype/dejavu/DejaVuSans-Bold.ttf";
  static const bool found = std::filesystem::exists(plain) && std::filesystem::exists(heavy);
  if (!found) return nullptr;
  return bold ? heavy : plain;
}

std::array<int, 4> bounds(const std::string& text, const TextStyle& style) {
  vtkNew<vtkTextProperty> property;
  apply(style, *property);
  std::array<int, 4> box{};
  vtkTextRenderer::GetInstance()->GetBoundingBox(property, text, box.data(), kDpi);
  return box;
}

}  // namespace

void apply(const TextStyle& style, vtkTextProperty& property) {
  if (const char* file = fontFile(style.bold)) {
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
  apply(style, *actor_->GetTextProperty());
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
