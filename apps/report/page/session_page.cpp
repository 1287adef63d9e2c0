#include "apps/report/page/session_page.h"

#include "apps/report/page/standing.h"

namespace palpa::report {
namespace {

void writeRemarks(Html& html, const std::vector<Remark>& remarks) {
  if (remarks.empty()) return;
  const auto section = html.in("section", {{"class", "card remarks"}});
  html.element("h2", "Noted by the educator");
  const auto list = html.in("ul");
  for (const Remark& remark : remarks) {
    const auto item = html.in("li");
    if (remark.trial > 0)
      html.element("span", {{"class", "time"}},
                   "Trial " + std::to_string(remark.trial) + ", " + fixed(remark.t_s, 1) + " s");
    html.text(remark.text);
  }
}

void writeNext(Html& html, const std::vector<std::string>& next) {
  for (std::size_t i = 0; i < next.size(); ++i) {
    const auto line = html.in("p", {{"class", "next"}});
    html.element("strong", i == 0 ? "Practise next:" : "Then:");
    html.text(" " + next[i] + ".");
  }
}

}  // namespace

void writeSessionHeader(Html& html, const SessionPage& page, std::size_t trials, bool simulated,
                        const std::function<void()>& more) {
  const auto header = html.in("header");
  html.element("h1", page.title);
  writeWho(html, page.trainee, page.when, trials);
  if (simulated) writeSimulatedBanner(html);
  writeNext(html, page.next);
  writeRemarks(html, page.remarks);
  more();
}

void writeSessionEnd(Html& html, const SessionPage& page, const std::function<void()>& more,
                     const std::function<void()>& terms) {
  writeStanding(html, page.engine, page.judged, page.others);
  const auto appendix = html.in("details", {{"class", "card appendix"}});
  html.element("summary", "How it was done: the task, the station, what the words mean");
  writeFacts(html, "Where this task stands", page.taxonomy);
  more();
  writeFacts(html, "Station", page.station);
  writeFacts(html, "Notes of the program", page.notes);
  if (!terms) return;
  const auto card = html.in("div", {{"class", "card"}});
  terms();
}

}  // namespace palpa::report
