#include "apps/report/data_table.h"

namespace palpa::report {
namespace {

void writeRows(Html& html, const DataTable& data) {
  const auto scroll = html.in("div", {{"class", "scroll"}, {"tabindex", "0"}});
  const auto table = html.in("table", {{"class", "data"}});
  {
    const auto head = html.in("thead"), row = html.in("tr");
    for (std::size_t i = 0; i < data.columns.size(); ++i)
      html.element("th", {{"scope", "col"}, {"class", i >= data.words_from ? "words" : ""}},
                   data.columns[i]);
  }
  const auto body = html.in("tbody");
  for (const std::vector<std::string>& cells : data.rows) {
    const auto row = html.in("tr");
    for (std::size_t i = 0; i < cells.size(); ++i) {
      if (i == 0)
        html.element("th", {{"scope", "row"}}, cells[i]);
      else
        html.element("td", {{"class", i >= data.words_from ? "words" : ""}}, cells[i]);
    }
  }
}

}  // namespace

void writeDataTable(Html& html, const DataTable& table) {
  if (table.rows.empty()) return;
  const auto details = html.in("details", {{"class", "behind"}});
  html.element("summary", table.title);
  writeRows(html, table);
}

void writeOpenTable(Html& html, const DataTable& table) {
  if (!table.rows.empty()) writeRows(html, table);
}

}  // namespace palpa::report
