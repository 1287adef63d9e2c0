#include "apps/calibrate/page.h"

#include <algorithm>
#include <cmath>

#include "apps/calibrate/page_frame.h"
#include "apps/calibrate/page_plots.h"

namespace palpa::calibrate {
namespace {

using report::Html;

void writeVerdict(Html& html, const std::vector<Result>& results) {
  const bool good =
      std::all_of(results.begin(), results.end(), [](const Result& r) { return r.file.passed(); });
  const auto verdict = html.in("div", {{"class", good ? "verdict good" : "verdict bad"}});
  const auto finding = html.in("div", {{"class", "finding"}});
  html.element("p", {{"class", "outcome"}},
               good ? "✓ Ready: sessions on this station are scored"
                    : "✗ Not ready: sessions on this station are not scored");
  for (const Result& r : results)
    html.element("p", (r.file.passed() ? "✓ " : "✗ ") + r.title +
                          (r.file.passed() ? "" : ": " + r.file.verdict));
}

void writeChecks(Html& html, const Result& r) {
  if (r.file.checks.empty()) return;
  const auto table = html.in("table", {{"class", "facts"}});
  const auto body = html.in("tbody");
  for (const auto& check : r.file.checks)
    writeFact(html, (check.passed() ? "✓ " : "✗ ") + check.name, quantity(check.value, check.unit),
              "good up to " + quantity(check.limit, check.unit));
}

/// "recorded files: pivot.csv, spin.csv"
std::string sourceOf(const station::CalibrationFile::Data& data) {
  constexpr std::size_t kNamed = 3;
  std::string words = data.source;
  for (std::size_t i = 0; i < std::min(kNamed, data.files.size()); ++i)
    words += (i ? ", " : ": ") + data.files[i].name;
  return data.files.size() > kNamed
             ? words + " and " + std::to_string(data.files.size() - kNamed) + " more"
             : words;
}

void writeResult(Html& html, const Result& r) {
  const auto section = html.in("section", {{"class", "card"}});
  html.element("h2", r.title);
  for (const std::string& sentence : r.sentences) html.element("p", sentence);
  writeChecks(html, r);
  for (const std::string& advice : r.advice) html.element("p", {{"class", "muted"}}, advice);
  html.element("p", {{"class", "muted small"}},
               "Good for " + std::to_string(r.file.valid_days) + " days. " +
                   std::to_string(r.file.data.used) + " of " + std::to_string(r.file.data.samples) +
                   " samples used, from: " + sourceOf(r.file.data) + ".");
  if (!r.coverage.counts.empty()) drawCoverage(html, r.coverage);
  for (const Plot& plot : r.plots) drawPlot(html, plot);
}

}  // namespace

void writePage(const PageHead& head, const std::vector<Result>& results,
               const std::filesystem::path& file) {
  PageFrame frame{"Calibration · " + head.station,
                  "Calibration of the station",
                  {{"Station", head.station}, {"Date", head.date}},
                  "",
                  ""};
  if (head.seconds > 0) frame.who.emplace_back("Took", quantity(head.seconds, "s"));
  if (head.simulated)
    frame.simulated =
        "Made on the virtual bench by a simulated hand: it says nothing about a real station.";
  const auto main = [&](Html& html) {
    for (const Result& r : results) writeResult(html, r);
    if (head.remarks.empty()) return;
    const auto section = html.in("section", {{"class", "card"}});
    html.element("h2", "Against the simulated truth");
    for (const std::string& remark : head.remarks) html.element("p", remark);
  };
  writeFramed(
      frame, [&](Html& html) { writeVerdict(html, results); }, main, file);
}

}  // namespace palpa::calibrate
