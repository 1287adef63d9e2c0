#include "scene/overlay/hud.h"

#include <vtkRenderer.h>

#include <algorithm>
#include <string>
#include <utility>
#include <vector>

#include "scene/actors/force_arrows.h"
#include "scene/actors/surface_map.h"
#include "scene/overlay/label.h"

namespace palpa::scene {
namespace {

std::set<ForceKind> kindsDrawn(const std::vector<ForceArrow>& forces) {
  std::set<ForceKind> kinds;
  for (const ForceArrow& force : forces)
    if (force.f_A.norm() >= ForceArrows::kWeakest) kinds.insert(force.kind);
  return kinds;
}

bool anyCut(const std::vector<ForceArrow>& forces) {
  return std::any_of(forces.begin(), forces.end(), [](const ForceArrow& force) {
    return force.f_A.norm() > ForceArrows::kLongest;
  });
}

/// Colour and share of the strip's height of a mark.
std::pair<Rgb, double> lookOf(TickTone tone) {
  switch (tone) {
    case TickTone::good:
      return {colour::kTickGood, 0.5};
    case TickTone::guide:
      return {colour::kMark, 0.7};
    case TickTone::bad:
      return {colour::kTickBad, 1.0};
    case TickTone::neutral:
      break;
  }
  return {colour::kTextDim, 0.35};
}

Rgba opaque(const Rgb& c) { return {c[0], c[1], c[2], 1}; }

}  // namespace

int textSize_px(int window_height, double scale) {
  const int least = static_cast<int>(scale * kSmallestText_px + 0.5);
  return std::max(least, (window_height + 24) / 48);
}

int stripHeight_px(int text_px) {
  return lineHeight({static_cast<int>(0.85 * text_px + 0.5)}) + 2 * (text_px / 2);
}

struct HudPainter::Content {
  Hud text;
  std::set<ForceKind> kinds;
  bool cut = false;
  Rect panel;
  int text_px = 0;
  bool operator==(const Content&) const = default;
};

HudPainter::HudPainter(vtkRenderer& renderer, ForceColours colours)
    : plates_(renderer), renderer_(renderer), colours_(colours) {}
HudPainter::~HudPainter() = default;

void HudPainter::update(const Hud& text, const std::vector<ForceArrow>& forces, const Rect& panel,
                        int text_px, const Surroundings& surroundings) {
  Content wanted{text, kindsDrawn(forces), anyCut(forces), panel, text_px};
  if (!content_ || !(*content_ == wanted)) {
    content_ = std::make_unique<Content>(std::move(wanted));
    panel_ = panel;
    build();
  }
  makeWay(surroundings);
}

bool HudPainter::alarms() const { return content_->text.alarm; }

/// Left end of a plate on this side.
int HudPainter::startOf(int width, bool right) const {
  const Rect& panel = content_->panel;
  return right ? panel.right() - margin_ - width : panel.x + margin_;
}

/// Whether it is drawn: what has no room in the panel is not, but for an alarm.
bool HudPainter::put(Plate plate, const Rect& frame) {
  if (!hasRoom(frame) && !(plate == Plate::notice && alarms())) return false;
  placed_.push_back({plate, frame});
  return !hidden_.contains(plate);
}

void HudPainter::build() {
  text_ = content_->text_px;
  margin_ = text_ * 3 / 4;
  below_ = content_->panel.top() - margin_;
  above_ = content_->panel.y + margin_;
  used_ = 0;
  plates_.clear();
  placed_.clear();
  buildMark();
  buildPhase();
  buildTimeline();
  buildLegend();
  buildScale();
  buildReadings();
  buildNotice();
  for (std::size_t i = used_; i < labels_.size(); ++i) labels_[i]->hide();
}

void HudPainter::buildMark() {
  const std::string& text = content_->text.mark;
  if (text.empty()) return;
  const Rect& panel = content_->panel;
  const TextStyle look = fitted(text, style(0.82, true, colour::kMark), panel.width / 2);
  const int pad = text_ / 2, width = textWidth(text, look) + 2 * pad;
  const int height = lineHeight(look) + pad;
  const Rect frame{startOf(width, !upper_right_), panel.top() - margin_ - height, width, height};
  if (panel.width < 40 * text_)
    below_ -= height + margin_ / 2;  // narrow: the badge has its own line
  if (!put(Plate::mark, frame)) return;
  plates_.add(frame, opaque(colour::kMark), pad);
  plates_.add({frame.x + 1, frame.y + 1, width - 2, height - 2}, {0.06, 0.06, 0.06, 1}, pad - 1);
  write(text, look, frame.x + width / 2, frame.y + height / 2, Align::centre);
}

/// In one line, or in two where it is too long for one.
void HudPainter::buildPhase() {
  const std::string& text = content_->text.phase;
  if (text.empty()) return;
  const int pad = text_ * 2 / 3, room = panel_.width - 2 * (margin_ + pad);
  const TextStyle wish = style(1.15, true, colour::kText);
  const Lines lines = fittedLines(text, wish, fitted(text, wish, room), room);
  const int width = lines.width + 2 * pad, height = lines.height + pad;
  const Rect frame{startOf(width, upper_right_), below_ - height, width, height};
  below_ = frame.y - margin_ / 2;
  if (!put(Plate::phase, frame)) return;
  plates_.add(frame, colour::kPlate, pad / 2);
  const bool one = lines.texts.size() == 1;
  const int top = one ? frame.y + height / 2 + lines.height / 2 : frame.top() - pad / 2;
  write(lines, frame.x + pad, top, Align::left);
}

std::vector<HudPainter::Row> HudPainter::readings() const {
  const Hud& text = content_->text;
  std::vector<Row> rows{{"Time", text.time},       {"Depth", text.depth},
                        {"Force", text.force},     {"Touched", text.touched},
                        {"Overlay", text.overlay}, {"Marked", text.marked},
                        {"Note", text.note}};
  for (Row& row : rows) row.name = said(row.name);
  std::erase_if(rows, [](const Row& row) { return row.value.empty(); });
  return rows;
}

void HudPainter::buildReadings() {
  readings_ = all_readings_ = {content_->panel.x, above_, 1, 1};
  constexpr std::size_t kFew = 3;
  std::vector<Row> rows = readings();
  if (rows.empty()) return;
  const TextStyle dim = style(0.90, false, colour::kTextDim),
                  bright = style(1, true, colour::kText);
  int names = 0, values = 0;
  for (const Row& row : rows) {
    names = std::max(names, textWidth(row.name, dim));
    values = std::max(values, textWidth(row.value, bright));
  }
  const int pad = text_ * 2 / 3, line = lineHeight(bright) * 11 / 10;
  const int width = names + values + 3 * pad;
  const auto plate = [&](std::size_t count) {
    return Rect{startOf(width, lower_right_), above_, width, static_cast<int>(count) * line + pad};
  };
  all_readings_ = plate(rows.size());
  if (few_readings_) rows.resize(std::min(rows.size(), kFew));
  const Rect frame = plate(rows.size());
  readings_ = frame;
  above_ = frame.top() + margin_;
  if (!put(Plate::readings, frame)) return;
  plates_.add(frame, colour::kPlate, pad / 2);
  int y = frame.top() - pad / 2 - line / 2;
  for (const Row& row : rows) {
    write(row.name, dim, frame.x + pad, y, Align::left);
    write(row.value, bright, frame.x + 2 * pad + names, y, Align::left);
    y -= line;
  }
}

void HudPainter::buildLegend() {
  if (content_->kinds.empty()) return;
  const TextStyle dim = style(0.85, false, colour::kTextDim),
                  bright = style(0.85, false, colour::kText);
  const int pad = text_ / 2, swatch = text_ * 2, bar = std::max(4, text_ / 3);
  const std::string scale = said(content_->cut ? "30 mm = 1 N, cut at 4 N" : "30 mm = 1 N");
  int width = pad;
  for (ForceKind kind : content_->kinds)
    width += swatch + textWidth(said(name(kind)), bright) + 3 * pad;
  const bool with_scale = width + textWidth(scale, dim) + pad <= panel_.width - 2 * margin_;
  if (with_scale) width += textWidth(scale, dim) + pad;
  const int height = lineHeight(bright) + pad;
  const Rect frame{startOf(width, lower_right_), above_, width, height};
  above_ = frame.top() + margin_;
  if (!put(Plate::legend, frame)) return;
  plates_.add(frame, colour::kPlate, pad / 2);
  int x = frame.x + pad;
  const int y = frame.y + height / 2;
  for (ForceKind kind : content_->kinds) {
    plates_.add({x, y - bar / 2 - 1, swatch, bar + 2}, opaque(arrowOutline(kind)), 2);
    plates_.add({x + 1, y - bar / 2, swatch - 2, bar}, opaque(arrowColour(kind, colours_)), 1);
    x += swatch + pad;
    write(said(name(kind)), bright, x, y, Align::left);
    x += textWidth(said(name(kind)), bright) + 2 * pad;
  }
  if (with_scale) write(scale, dim, x, y, Align::left);
}

/// "Stiffness  0.12 [colours] 0.31 N/mm  striped: not sure"
void HudPainter::buildScale() {
  if (!content_->text.scale) return;
  const ColourScale& scale = *content_->text.scale;
  constexpr int kParts = 48;
  const TextStyle dim = style(0.85, false, colour::kTextDim),
                  bright = style(0.85, false, colour::kText);
  const int pad = text_ / 2, part = std::max(2, text_ / 6), bar = kParts * part;
  const std::string unsure = scale.any_unsure ? said("striped: not sure") : "";
  const int width = textWidth(scale.title, dim) + textWidth(scale.low, bright) + bar +
                    textWidth(scale.high, bright) + 5 * pad +
                    (unsure.empty() ? 0 : textWidth(unsure, dim) + 2 * pad);
  const int height = lineHeight(bright) + pad;
  const Rect frame{startOf(width, lower_right_), above_, width, height};
  above_ = frame.top() + margin_;
  if (!put(Plate::scale, frame)) return;
  plates_.add(frame, colour::kPlate, pad / 2);
  int x = frame.x + pad;
  const int y = frame.y + height / 2;
  const auto write_on = [&](const std::string& text, const TextStyle& look) {
    write(text, look, x, y, Align::left);
    x += textWidth(text, look) + pad;
  };
  write_on(scale.title, dim);
  write_on(scale.low, bright);
  for (int i = 0; i < kParts; ++i)
    plates_.add({x + i * part, frame.y + pad / 2, part, height - pad},
                opaque(scaleColour((i + 0.5) / kParts)), 0);
  x += bar + pad;
  write_on(scale.high, bright);
  x += pad;
  if (!unsure.empty()) write_on(unsure, dim);
}

void HudPainter::buildTimeline() {
  if (!content_->text.timeline) return;
  const Timeline& strip = *content_->text.timeline;
  const TextStyle look = style(0.85, false, colour::kText);
  const int pad = text_ / 2, height = stripHeight_px(text_);
  const Rect frame{content_->panel.x + margin_, above_, content_->panel.width - 2 * margin_,
                   height};
  plates_.add(frame, colour::kPlate, pad / 2);
  const int middle = frame.y + height / 2, rate = textWidth(said("paused"), look);
  const auto left_for_track = [&](int time) { return frame.width - time - rate - 5 * pad; };
  int time = textWidth(said("88:88.8 of 88:88.8"), look);
  const bool with_whole = left_for_track(time) > frame.width / 4;
  if (!with_whole) time = textWidth("88:88.8", look);
  write(strip.time + (with_whole ? strip.whole : ""), look, frame.x + pad, middle, Align::left);
  write(strip.rate, look, frame.right() - pad, middle, Align::right);
  const Rect track{frame.x + time + 2 * pad, middle - 2, std::max(1, left_for_track(time)), 4};
  const auto across = [&](double share) { return track.x + static_cast<int>(share * track.width); };
  plates_.add(track, opaque(colour::kTextDim), 0);
  plates_.add({track.x, track.y, std::max(1, across(strip.at) - track.x), track.height},
              opaque(colour::kAdvice), 0);
  for (const Timeline::Tick& tick : strip.ticks) {
    const auto [tone, share] = lookOf(tick.tone);
    const int high = std::max(6, static_cast<int>(share * (height - 4)));
    plates_.add({across(tick.at) - 1, middle - high / 2, 3, high}, opaque(tone), 0);
  }
  plates_.add({across(strip.at) - 2, middle - height / 2 + 2, 4, height - 4}, opaque(colour::kText),
              1);
  above_ = frame.top() + margin_;
}

void HudPainter::buildNotice() {
  const bool calm = content_->text.notice.empty();
  const std::string& text = calm ? content_->text.can_do : content_->text.notice;
  if (text.empty()) return;
  const bool alarm = content_->text.alarm && !calm;
  const Rect& panel = content_->panel;
  const TextStyle wish = style(calm ? 1 : 1.45, alarm, colour::kText);
  const int pad = text_, room = panel.width - 2 * (margin_ + pad);
  const Lines lines = fittedLines(text, wish, wish, room);
  const int width = lines.width + 2 * pad;
  const int left = panel.x + (panel.width - width) / 2;
  const bool beside =
      lower_right_ ? left + width + margin_ < readings_.x : left > readings_.right() + margin_;
  const int height = lines.height + pad, down = beside ? readings_.y : above_, up = below_ - height;
  const Rect frame{left, notice_up_ ? up : down, width, height};
  notice_elsewhere_ = {left, notice_up_ ? down : up, width, height};
  if (!put(Plate::notice, frame)) return;
  write(lines, frame.x + width / 2, frame.top() - pad / 2, Align::centre);
  if (calm) return plates_.add(frame, colour::kPlate, text_ / 2);
  const Rgba edge = alarm ? opaque(colour::kText) : opaque(colour::kAdvice);
  const int rim = std::max(1, text_ / 8);
  plates_.add({frame.x - rim, frame.y - rim, width + 2 * rim, frame.height + 2 * rim}, edge,
              text_ / 2 + rim);
  plates_.add(frame, alarm ? colour::kAlarmPlate : Rgba{0.05, 0.07, 0.10, 1}, text_ / 2);
}

}  // namespace palpa::scene
