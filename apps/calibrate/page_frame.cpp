#include "apps/calibrate/page_frame.h"

#include "anatomy/geometry/whole_file.h"
#include "apps/calibrate/page_plots.h"
#include "apps/report/style.h"

namespace palpa::calibrate {
namespace {

using report::Html;

void writeFrameHead(Html& html, const PageFrame& frame) {
  const auto head = html.in("head");
  html.empty("meta", {{"charset", "utf-8"}});
  html.empty("meta", {{"name", "viewport"}, {"content", "width=device-width, initial-scale=1"}});
  html.empty("meta", {{"name", "color-scheme"}, {"content", "light dark"}});
  html.element("title", frame.window);
  const auto style = html.in("style");
  html.raw(report::styleSheet());
  html.raw(plotStyle());
  html.raw(frame.style);
}

void writeFrameTop(Html& html, const PageFrame& frame) {
  html.element("h1", frame.heading);
  {
    const auto who = html.in("p", {{"class", "who"}});
    for (const auto& [name, value] : frame.who) {
      const auto span = html.in("span");
      html.text(name + ' ');
      html.element("strong", value);
    }
  }
  if (frame.simulated.empty()) return;
  const auto banner = html.in("p", {{"class", "banner"}, {"role", "note"}});
  html.element("strong", "SIMULATED");
  html.text(frame.simulated);
}

}  // namespace

void writeFramed(const PageFrame& frame, const std::function<void(Html&)>& top,
                 const std::function<void(Html&)>& main, const std::filesystem::path& file) {
  Html html;
  html.raw("<!DOCTYPE html>\n");
  {
    const auto page = html.in("html", {{"lang", "en"}});
    writeFrameHead(html, frame);
    const auto body = html.in("body");
    {
      const auto header = html.in("header");
      writeFrameTop(html, frame);
      top(html);
    }
    const auto in_main = html.in("main");
    main(html);
  }
  writeWhole(file, html.str() + "\n");
}

void writeFact(Html& html, const std::string& name, const std::string& value,
               const std::string& note) {
  const auto row = html.in("tr");
  html.element("th", {{"scope", "row"}}, name);
  html.element("td", {{"class", "value"}}, value);
  html.element("td", {{"class", "muted"}}, note);
}

}  // namespace palpa::calibrate
