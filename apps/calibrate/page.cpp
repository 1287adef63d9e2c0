#include "apps/calibrate/page.h"

#include <algorithm>
#include <cmath>

#include "anatomy/geometry/whole_file.h"
#include "apps/calibrate/page_plots.h"
#include "apps/report/html.h"
#include "apps/report/style.h"

namespace palpa::calibrate {
namespace {

using report::Html;

void writeTop(Html& html, const PageHead& head, const std::vector<Result>& results) {
  const auto header = html.in("header");
  html.element("h1", "Calibration of the station");
  {
    const auto who = html.in("p", {{"class", "who"}});
    const auto item = [&](const char* name, const std::string& value) {
      const auto span = html.in("span");
      html.text(std::string(name) + ' ');
      html.element("strong", value);
    };
    item("Station", head.station);
    item("Date", head.date);
    if (head.seconds > 0) item("Took", quantity(head.seconds, "s"));
  }
  if (head.simulated) {
    const auto banner = html.in("p", {{"class", "banner"}, {"role", "note"}});
    html.element("strong", "SIMULATED");
    html.text("Made on the virtual bench by a simulated hand: it says nothing about a real station.");
  }
  const bool good = std::all_of(results.begin(), results.end(), [](const Result& r) { return r.file.passed(); });
  const auto verdict = html.in("div", {{"class", good ? "verdict good" : "verdict bad"}});
  const auto finding = html.in("div", {{"class", "finding"}});
  html.element("p", {{"class", "outcome"}}, good ? "✓ Ready: sessions on this station are scored" : "✗ Not ready: sessions on this station are not scored");
  for (const Result& r : results)
    html.element("p", (r.file.passed() ? "✓ " : "✗ ") + r.title + (r.file.passed() ? "" : ": " + r.file.verdict));
}

void writeChecks(Html& html, const Result& r) {
  if (r.file.checks.empty()) return;
  const auto table = html.in("table", {{"class", "facts"}});
  const auto body = html.in("tbody");
  for (const auto& check : r.file.checks) {
    const auto row = html.in("tr");
    html.element("th", {{"scope", "row"}}, (check.passed() ? "✓ " : "✗ ") + check.name);
    html.element("td", {{"class", "value"}}, quantity(check.value, check.unit));
    html.element("td", {{"class", "muted"}}, "good up to " + quantity(check.limit, check.unit));
  }
}

/// "recorded files: pivot.csv, spin.csv"
std::string sourceOf(const station::CalibrationFile::Data& data) {
  constexpr std::size_t kNamed = 3;
  std::string words = data.source;
  for (std::size_t i = 0; i < std::min(kNamed, data.files.size()); ++i) words += (i ? ", " : ": ") + data.files[i].name;
  return data.files.size() > kNamed ? words + " and " + std::to_string(data.files.size() - kNamed) + " more" : words;
}

void writeResult(Html& html, const Result& r) {
  const auto section = html.in("section", {{"class", "card"}});
  html.element("h2", r.title);
  for (const std::string& sentence : r.sentences) html.element("p", sentence);
  writeChecks(html, r);
  for (const std::string& advice : r.advice) html.element("p", {{"class", "muted"}}, advice);
  html.element("p", {{"class", "muted small"}}, "Good for " + std::to_string(r.file.valid_days) + " days. " + std::to_string(r.file.data.used) + " of " +
                                                     std::to_string(r.file.data.samples) + " samples used, from: " + sourceOf(r.file.data) + ".");
  if (!r.coverage.counts.empty()) drawCoverage(html, r.coverage);
  for (const Plot& plot : r.plots) drawPlot(html, plot);
}

}  // namespace

void writePage(const PageHead& head, const std::vector<Result>& results, const std::filesystem::path& file) {
  Html html;
  html.raw("<!DOCTYPE html>\n");
  {
    const auto page = html.in("html", {{"lang", "en"}});
    {
      const auto in_head = html.in("head");
      html.empty("meta", {{"charset", "utf-8"}});
      html.empty("meta", {{"name", "viewport"}, {"content", "width=device-width, initial-scale=1"}});
      html.empty("meta", {{"name", "color-scheme"}, {"content", "light dark"}});
      html.element("title", "Calibration · " + head.station);
      const auto style = html.in("style");
      html.raw(report::styleSheet());
      html.raw(plotStyle());
    }
    const auto body = html.in("body");
    writeTop(html, head, results);
    const auto main = html.in("main");
    for (const Result& r : results) writeResult(html, r);
    if (!head.remarks.empty()) {
      const auto section = html.in("section", {{"class", "card"}});
      html.element("h2", "Against the simulated truth");
      for (const std::string& remark : head.remarks) html.element("p", remark);
    }
  }
  writeWhole(file, html.str() + "\n");
}

}  // namespace palpa::calibrate
