#include "scene/overlay/help_plate.h"

#include <algorithm>

namespace palpa::scene {
namespace {

constexpr const char* kHelpTitle = "Keys";
constexpr const char* kHelpClose = "? closes this";
constexpr Rgba kHelpGround{0.05, 0.07, 0.10, 0.95};

struct HelpLayout {
  TextStyle key, words, small;
  int line = 0, keys_wide = 0, width = 0, height = 0, pad = 0;
};

HelpLayout helpLayout(const std::vector<KeyHelp>& keys, std::size_t rows, int text_px) {
  HelpLayout l{{text_px, true, colour::kText},
               {text_px, false, colour::kText},
               {std::max(kSmallestText_px, text_px * 17 / 20), false, colour::kTextDim}};
  l.pad = text_px;
  l.line = lineHeight(l.words) + text_px / 4;
  int words_wide = textWidth(said(kHelpClose), l.small);
  for (std::size_t i = 0; i < rows; ++i) {
    l.keys_wide = std::max(l.keys_wide, textWidth(keys[i].key, l.key));
    words_wide = std::max(words_wide, textWidth(keys[i].words, l.words));
  }
  l.width = l.keys_wide + words_wide + 3 * l.pad;
  l.height = static_cast<int>(rows + 2) * l.line + l.pad;
  return l;
}

bool fits(const HelpLayout& l, const Rect& panel) {
  return l.width <= panel.width && l.height <= panel.height;
}

}  // namespace

HelpPlate::HelpPlate(vtkRenderer& renderer) : plates_(renderer), renderer_(renderer) {}
HelpPlate::~HelpPlate() = default;

void HelpPlate::update(const std::vector<KeyHelp>& keys, const Rect& panel, int text_px) {
  if (keys == keys_ && panel == panel_ && text_px == text_px_) return;
  keys_ = keys;
  panel_ = panel;
  text_px_ = text_px;
  build();
}

void HelpPlate::write(const std::string& text, const TextStyle& style, int x, int y, Align align) {
  if (used_ == labels_.size()) labels_.push_back(std::make_unique<Label>(renderer_));
  labels_[used_++]->set(text, style, x, y, align);
}

void HelpPlate::build() {
  plates_.clear();
  used_ = 0;
  std::size_t rows = keys_.size();
  int text_px = text_px_;
  while (rows > 0 && !fits(helpLayout(keys_, rows, text_px), panel_))
    text_px > kSmallestText_px ? static_cast<void>(--text_px) : static_cast<void>(--rows);
  if (rows > 0) {
    const HelpLayout l = helpLayout(keys_, rows, text_px);
    const Rect frame{panel_.x + (panel_.width - l.width) / 2,
                     panel_.y + (panel_.height - l.height) / 2, l.width, l.height};
    plates_.add({frame.x - 1, frame.y - 1, l.width + 2, l.height + 2},
                {colour::kAdvice[0], colour::kAdvice[1], colour::kAdvice[2], 1}, l.pad / 2);
    plates_.add(frame, kHelpGround, l.pad / 2);
    const int words = frame.x + 2 * l.pad + l.keys_wide;
    int y = frame.top() - l.pad / 2 - l.line / 2;
    write(said(kHelpTitle), l.key, frame.x + l.pad, y, Align::left);
    write(said(kHelpClose), l.small, frame.right() - l.pad, y, Align::right);
    y -= l.line / 2;
    for (std::size_t i = 0; i < rows; ++i) {
      y -= l.line;
      write(keys_[i].key, l.key, frame.x + l.pad, y, Align::left);
      write(keys_[i].words, l.words, words, y, Align::left);
    }
  }
  for (std::size_t i = used_; i < labels_.size(); ++i) labels_[i]->hide();
}

}  // namespace palpa::scene
