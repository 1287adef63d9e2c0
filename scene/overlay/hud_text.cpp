#include <algorithm>
#include <string>
#include <utility>

#include "scene/overlay/hud.h"

namespace palpa::scene {
namespace {

/// Breaks a line at the space nearest its middle; unchanged when there is none.
std::pair<std::string, std::string> halves(const std::string& text) {
  const std::size_t middle = text.size() / 2;
  const std::size_t before = text.rfind(' ', middle), after = text.find(' ', middle);
  if (before == std::string::npos && after == std::string::npos) return {text, ""};
  const bool first = after == std::string::npos ||
                     (before != std::string::npos && middle - before <= after - middle);
  const std::size_t at = first ? before : after;
  return {text.substr(0, at), text.substr(at + 1)};
}

}  // namespace

void HudPainter::write(const std::string& text, const TextStyle& style, int x, int y, Align align) {
  if (used_ == labels_.size()) labels_.push_back(std::make_unique<Label>(renderer_));
  labels_[used_++]->set(text, style, x, y, align);
}

TextStyle HudPainter::style(double scale, bool bold, const Rgb& colour) const {
  return {std::max(static_cast<int>(scale * text_ + 0.5), kSmallestText_px), bold, colour};
}

TextStyle HudPainter::fitted(const std::string& text, TextStyle wish, int width) const {
  while (wish.size_px > kSmallestText_px && textWidth(text, wish) > width) --wish.size_px;
  return wish;
}

/// A line that is wider than the room when it looks as `alone` is broken in two; then all shrink
/// from `wish` until they have room.
HudPainter::Lines HudPainter::fittedLines(const std::string& text, const TextStyle& wish,
                                          const TextStyle& alone, int room) const {
  Lines lines;
  for (std::size_t at = 0; at <= text.size();) {
    const std::size_t end = std::min(text.find('\n', at), text.size());
    const std::string line = text.substr(at, end - at);
    const auto [first, second] =
        textWidth(line, alone) > room ? halves(line) : std::pair(line, std::string());
    lines.texts.push_back(first);
    if (!second.empty()) lines.texts.push_back(second);
    at = end + 1;
  }
  lines.look = lines.texts.size() == 1 ? alone : wish;
  for (const std::string& line : lines.texts) lines.look = fitted(line, lines.look, room);
  for (const std::string& line : lines.texts)
    lines.width = std::max(lines.width, textWidth(line, lines.look));
  lines.height = static_cast<int>(lines.texts.size()) * lineHeight(lines.look);
  return lines;
}

/// One below the other from `top` on.
void HudPainter::write(const Lines& lines, int x, int top, Align align) {
  const int line = lineHeight(lines.look);
  for (const std::string& text : lines.texts) {
    write(text, lines.look, x, top - line / 2, align);
    top -= line;
  }
}

}  // namespace palpa::scene
