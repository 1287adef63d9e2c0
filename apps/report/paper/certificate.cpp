#include "apps/report/paper/certificate.h"

#include <memory>
#include <sstream>

#include <cairo/cairo-pdf.h>

#include "anatomy/base/error.h"
#include "anatomy/base/fonts.h"
#include "anatomy/base/whole_file.h"
#include "apps/language/languages.h"

namespace palpa::report {
namespace {

constexpr double kPointsOfMm = 72 / 25.4;                                             // a mm
constexpr double kPaperWide = 210, kPaperHigh = 297, kPaperEdge = 24, kFactsAt = 52;  // mm
constexpr double kLineHigh = 1.45;  // of the size of the type

/// Words on the sheet, from above; lengths in mm.
class CertificateSheet {
 public:
  explicit CertificateSheet(cairo_t* cairo) : cairo_(cairo) {}

  void skip(double mm) { y_ += mm; }
  void rule() {
    cairo_set_source_rgb(cairo_, 0.75, 0.78, 0.8);
    cairo_rectangle(cairo_, kPaperEdge, y_, kPaperWide - 2 * kPaperEdge, 0.3);
    cairo_fill(cairo_);
    y_ += 5;
  }
  /// Broken between words where the line is full.
  void words(const std::string& text, double size, bool bold, double left = kPaperEdge) {
    const std::string in_words = language::written().book.said(text);
    use(fontOf(in_words), size, bold);
    std::istringstream in(in_words);
    std::string line;
    for (std::string word; in >> word;) {
      const std::string longer = line.empty() ? word : line + ' ' + word;
      if (!line.empty() && widthOf(longer) > kPaperWide - kPaperEdge - left) {
        put(line, size, left);
        line = word;
      } else {
        line = longer;
      }
    }
    if (!line.empty()) put(line, size, left);
  }
  void fact(const std::string& name, const std::string& value) {
    const double y = y_;
    words(name, 4, false);
    y_ = y;
    words(value, 4, true, kPaperEdge + kFactsAt);
    y_ += 1;
  }
  void foot(const std::string& text) {
    y_ = kPaperHigh - kPaperEdge;
    words(text, 3, false);
  }

 private:
  void use(const Font& font, double size, bool bold) {
    cairo_select_font_face(cairo_, font.family, CAIRO_FONT_SLANT_NORMAL,
                           bold ? CAIRO_FONT_WEIGHT_BOLD : CAIRO_FONT_WEIGHT_NORMAL);
    cairo_set_font_size(cairo_, size);
    cairo_set_source_rgb(cairo_, 0.09, 0.13, 0.17);
  }
  double widthOf(const std::string& text) {
    cairo_text_extents_t extents;
    cairo_text_extents(cairo_, text.c_str(), &extents);
    return extents.x_advance;
  }
  void put(const std::string& line, double size, double left) {
    y_ += size * kLineHigh;
    cairo_move_to(cairo_, left, y_);
    cairo_show_text(cairo_, line.c_str());
  }

  cairo_t* cairo_;
  double y_ = kPaperEdge;
};

void drawCertificate(cairo_t* cairo, const Certificate& c) {
  CertificateSheet sheet(cairo);
  if (c.simulated) {
    sheet.words(
        "SIMULATED: the operator or the bench is simulated. This says nothing about a person.", 3.6,
        true);
    sheet.skip(6);
  }
  sheet.words("Certificate of an examined trial", 5, false);
  sheet.words(c.task, 9, true);
  sheet.words("Passed", 9, true);
  sheet.skip(6);
  sheet.rule();
  for (const auto& [name, value] : c.facts) sheet.fact(name, value);
  sheet.skip(6);
  sheet.words("What was judged", 5, true);
  sheet.skip(1);
  for (const std::string& sentence : c.judged) sheet.words(sentence, 4, false);
  sheet.skip(6);
  sheet.words("What this does not show", 5, true);
  sheet.skip(1);
  for (const std::string& sentence : c.limits) sheet.words(sentence, 4, false);
  sheet.skip(24);
  sheet.words("______________________________     ____________________", 4, false);
  sheet.words("Signature of the rater, date", 3, false);
  sheet.foot(c.made_by);
}

cairo_status_t keepBytes(void* text, const unsigned char* data, unsigned length) {
  static_cast<std::string*>(text)->append(reinterpret_cast<const char*>(data), length);
  return CAIRO_STATUS_SUCCESS;
}

}  // namespace

void writeCertificate(const Certificate& certificate, const std::filesystem::path& file) {
  if (file.extension() != ".pdf")
    throw UsageError("does not end in .pdf", file.string(), "Choose a name that does");
  std::string bytes;
  {
    const std::unique_ptr<cairo_surface_t, decltype(&cairo_surface_destroy)> surface(
        cairo_pdf_surface_create_for_stream(keepBytes, &bytes, kPaperWide * kPointsOfMm,
                                            kPaperHigh * kPointsOfMm),
        cairo_surface_destroy);
    const std::string title = "Certificate: " + certificate.task;
    cairo_pdf_surface_set_metadata(surface.get(), CAIRO_PDF_METADATA_TITLE, title.c_str());
    const std::unique_ptr<cairo_t, decltype(&cairo_destroy)> cairo(cairo_create(surface.get()),
                                                                   cairo_destroy);
    cairo_scale(cairo.get(), kPointsOfMm, kPointsOfMm);
    drawCertificate(cairo.get(), certificate);
    cairo_show_page(cairo.get());
    cairo_surface_finish(surface.get());
    if (cairo_surface_status(surface.get()) != CAIRO_STATUS_SUCCESS)
      throw Error("cannot be drawn", file.string(), "Is there memory left?");
  }
  writeWhole(file, bytes);
}

}  // namespace palpa::report
