#include "apps/report/paper/board_page.h"

#include <cairo/cairo-pdf.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <memory>

#include "anatomy/base/error.h"
#include "anatomy/base/fonts.h"
#include "anatomy/base/whole_file.h"
#include "apps/language/languages.h"

namespace palpa::report {
namespace {

constexpr double kPointsPerMm = 72 / 25.4, kFooter_mm = 21, kEdge_mm = 5, kBar_mm = 100;

struct PaperSize {
  const char* name;
  double short_mm, long_mm;
};
constexpr PaperSize kPapers[] = {
    {"a4", 210, 297},         {"a3", 297, 420},          {"a2", 420, 594}, {"a1", 594, 841},
    {"letter", 215.9, 279.4}, {"tabloid", 279.4, 431.8}, {"fit", 0, 0}};

const PaperSize& paperOf(const std::string& name) {
  for (const PaperSize& paper : kPapers)
    if (name == paper.name) return paper;
  throw UsageError("is not a paper size", name, "Choose a4, a3, a2, a1, letter, tabloid or fit");
}

PageSize sizeOf(const ar::Sheet& sheet, const std::string& name) {
  const PaperSize& paper = paperOf(name);
  const double width = 1e3 * sheet.size.x(), height = 1e3 * sheet.size.y();
  if (!(paper.short_mm > 0))
    return {std::max(width, kBar_mm) + 4 * kEdge_mm,
            std::max(height, kBar_mm) + kFooter_mm + 2 * kEdge_mm};
  const auto holds = [&](double w, double h) {
    return width <= w - 2 * kEdge_mm && height <= h - kFooter_mm - kEdge_mm;
  };
  if (holds(paper.short_mm, paper.long_mm)) return {paper.short_mm, paper.long_mm};
  if (holds(paper.long_mm, paper.short_mm)) return {paper.long_mm, paper.short_mm};
  char words[160];
  std::snprintf(words, sizeof words,
                "is %.0f x %.0f mm large, too large for %s with its margins and the scale bar",
                width, height, paper.name);
  throw UsageError(words, sheet.what, "Choose a larger --paper, fit, or a smaller board");
}

/// Millimetres from the upper left corner of the page.
class Pen {
 public:
  explicit Pen(cairo_t* cairo) : cairo_(cairo) {}

  void white() const {
    cairo_set_source_rgb(cairo_, 1, 1, 1);
    cairo_paint(cairo_);
    cairo_set_source_rgb(cairo_, 0, 0, 0);
  }
  void rectangle(double x, double y, double width, double height) const {
    cairo_rectangle(cairo_, x, y, width, height);
  }
  /// All at once: no seams where rectangles touch.
  void fill() const { cairo_fill(cairo_); }
  void words(double x, double y, double size, const std::string& english) const {
    const std::string text = language::written().book.said(english);
    cairo_select_font_face(cairo_, fontOf(text).family, CAIRO_FONT_SLANT_NORMAL,
                           CAIRO_FONT_WEIGHT_NORMAL);
    cairo_set_font_size(cairo_, size);
    cairo_move_to(cairo_, x, y);
    cairo_show_text(cairo_, text.c_str());
  }

 private:
  cairo_t* cairo_;
};

/// Every centimetre black or white in turn, framed by ticks.
void drawBar(const Pen& pen, double x, double y, bool across) {
  constexpr double kThick = 1.6, kTick = 3.2, kHair = 0.2;
  const auto box = [&](double along, double beside, double length, double thickness) {
    if (across)
      pen.rectangle(x + along, y + beside, length, thickness);
    else
      pen.rectangle(x + beside, y + along, thickness, length);
  };
  for (int cm = 0; cm < 10; cm += 2) box(10 * cm, 0, 10, kThick);
  box(0, 0, kBar_mm, kHair);
  box(0, kThick - kHair, kBar_mm, kHair);
  for (const double end : {0.0, kBar_mm - kHair}) box(end, -(kTick - kThick) / 2, kHair, kTick);
  pen.fill();
}

void drawPage(const Pen& pen, const ar::Sheet& sheet, const BoardPage& page, const PageSize& size) {
  pen.white();
  const double middle_x = size.width_mm / 2,
               middle_y = (size.height_mm - kFooter_mm + kEdge_mm) / 2;
  for (const ar::Sheet::Black& b : sheet.black)
    pen.rectangle(middle_x + 1e3 * b.left, middle_y - 1e3 * (b.bottom + b.height), 1e3 * b.width,
                  1e3 * b.height);
  pen.fill();
  const double left = middle_x - 500 * sheet.size.x(), foot = size.height_mm - kFooter_mm + 6;
  const double bar = std::max(kEdge_mm, std::min(left, middle_x - kBar_mm / 2));
  drawBar(pen, bar, foot, true);
  pen.words(bar, foot + 6, 3.2,
            "100 mm. Print at 100 %, then measure: the board is true only if this is.");
  pen.words(bar, foot + 10.5, 2.8, page.words);
  if (left > 2.5 * kEdge_mm && size.height_mm > kBar_mm + kFooter_mm + 2 * kEdge_mm)
    drawBar(pen, kEdge_mm + 2, middle_y - kBar_mm / 2, false);
}

cairo_status_t append(void* text, const unsigned char* data, unsigned length) {
  static_cast<std::string*>(text)->append(reinterpret_cast<const char*>(data), length);
  return CAIRO_STATUS_SUCCESS;
}

using Surface = std::unique_ptr<cairo_surface_t, decltype(&cairo_surface_destroy)>;

void draw(cairo_surface_t* surface, double units_per_mm, const ar::Sheet& sheet,
          const BoardPage& page, const PageSize& size) {
  const std::unique_ptr<cairo_t, decltype(&cairo_destroy)> cairo(cairo_create(surface),
                                                                 &cairo_destroy);
  cairo_set_antialias(cairo.get(), CAIRO_ANTIALIAS_BEST);
  cairo_scale(cairo.get(), units_per_mm, units_per_mm);
  drawPage(Pen(cairo.get()), sheet, page, size);
  cairo_show_page(cairo.get());
}

std::string pdfOf(const ar::Sheet& sheet, const BoardPage& page, const PageSize& size) {
  std::string text;
  const Surface surface(
      cairo_pdf_surface_create_for_stream(append, &text, size.width_mm * kPointsPerMm,
                                          size.height_mm * kPointsPerMm),
      &cairo_surface_destroy);
  cairo_pdf_surface_set_metadata(surface.get(), CAIRO_PDF_METADATA_TITLE, page.words.c_str());
  draw(surface.get(), kPointsPerMm, sheet, page, size);
  cairo_surface_finish(surface.get());
  return text;
}

std::string pngOf(const ar::Sheet& sheet, const BoardPage& page, const PageSize& size) {
  const double px_per_mm = page.dpi / 25.4;
  const auto pixels = [&](double mm) { return static_cast<int>(std::lround(mm * px_per_mm)); };
  if (std::max(pixels(size.width_mm), pixels(size.height_mm)) > 30'000)
    throw UsageError("makes a picture of more than 30000 pixels a side", "--dpi",
                     "Choose fewer dots per inch, or a PDF");
  if (1e3 * sheet.smallest * px_per_mm < 2)
    throw UsageError("leaves less than two pixels for a cell of the board", "--dpi",
                     "Choose more dots per inch, or a PDF");
  std::string bytes;
  const Surface surface(
      cairo_image_surface_create(CAIRO_FORMAT_RGB24, pixels(size.width_mm), pixels(size.height_mm)),
      &cairo_surface_destroy);
  draw(surface.get(), px_per_mm, sheet, page, size);
  if (cairo_surface_write_to_png_stream(surface.get(), append, &bytes) != CAIRO_STATUS_SUCCESS)
    throw Error("the picture cannot be made", sheet.what, "Choose fewer dots per inch, or a PDF");
  return bytes;
}

}  // namespace

const std::vector<std::string>& papers() {
  static const std::vector<std::string> names = [] {
    std::vector<std::string> all;
    for (const PaperSize& paper : kPapers) all.emplace_back(paper.name);
    return all;
  }();
  return names;
}

PageSize writeBoardPage(const ar::Sheet& sheet, const BoardPage& page,
                        const std::filesystem::path& file) {
  const std::string ending = file.extension().string();
  if (ending != ".pdf" && ending != ".png")
    throw UsageError("ends in neither .pdf nor .png", file.string(), "Choose a name that does");
  const PageSize size = sizeOf(sheet, page.paper);
  writeWhole(file, ending == ".pdf" ? pdfOf(sheet, page, size) : pngOf(sheet, page, size));
  return size;
}

}  // namespace palpa::report
