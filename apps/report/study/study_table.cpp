#include "apps/report/study/study_exhibits.h"

#include <cmath>
#include <nlohmann/json.hpp>
#include <set>

#include "anatomy/base/text_forms.h"
#include "apps/report/page/page_parts.h"

namespace palpa::report {
namespace {

using study_analysis::Cell;
using study_analysis::Column;

bool isText(const Cell& cell) { return std::holds_alternative<std::string>(cell); }

/// Columns whose names two share are numbered, so that files tell them apart.
std::vector<std::string> namesIn(const study_analysis::Table& table) {
  std::vector<std::string> names;
  std::set<std::string> taken;
  for (const Column& c : table.columns) {
    std::string name = c.name;
    for (int again = 2; !taken.insert(name).second; ++again)
      name = c.name + "_" + std::to_string(again);
    names.push_back(name);
  }
  return names;
}

}  // namespace

std::string studyCell(const Cell& cell, const Column& column) {
  if (isText(cell)) return std::get<std::string>(cell);
  const double value = std::get<double>(cell);
  if (column.format == study_analysis::Format::p_value && value < std::pow(10, -column.decimals))
    return "< " + fixed(std::pow(10, -column.decimals), column.decimals);
  return fixed(value, column.decimals);
}

void writeStudyTable(Html& html, const study_analysis::Table& table) {
  const auto scroll = html.in("div", {{"class", "scroll"}});
  const auto all = html.in("table", {{"class", "study-table"}});
  {
    const auto head = html.in("thead");
    const auto row = html.in("tr");
    for (std::size_t c = 0; c < table.columns.size(); ++c) {
      if (!table.columns[c].page) continue;
      const bool words = !table.rows.empty() && isText(table.rows[0][c]);
      html.element("th", {{"scope", "col"}, {"class", words ? "words" : "figure"}},
                   table.columns[c].title);
    }
  }
  const auto body = html.in("tbody");
  for (const std::vector<Cell>& cells : table.rows) {
    const auto row = html.in("tr");
    for (std::size_t c = 0; c < cells.size(); ++c)
      if (table.columns[c].page)
        html.element("td", {{"class", isText(cells[c]) ? "words" : "figure"}},
                     studyCell(cells[c], table.columns[c]));
  }
}

std::string studyCsv(const study_analysis::Table& table, bool simulated) {
  std::string text;
  for (const std::string& name : namesIn(table)) text += csvField(name) + ',';
  text += "SIMULATED\n";
  for (const std::vector<Cell>& cells : table.rows) {
    for (const Cell& cell : cells) {
      if (isText(cell))
        text += csvField(std::get<std::string>(cell));
      else if (std::isfinite(std::get<double>(cell)))
        text += shortest(std::get<double>(cell));
      text += ',';
    }
    text += simulated ? "1\n" : "0\n";
  }
  return text;
}

std::string studyJson(const study_analysis::Exhibit& exhibit, bool simulated) {
  nlohmann::ordered_json json{{"id", exhibit.id},
                              {"title", exhibit.title},
                              {"caption", exhibit.caption},
                              {"simulated", simulated},
                              {"columns", nlohmann::json::array()},
                              {"rows", nlohmann::json::array()},
                              {"notes", exhibit.notes}};
  const std::vector<std::string> names = namesIn(exhibit.table);
  for (std::size_t c = 0; c < names.size(); ++c)
    json["columns"].push_back(
        nlohmann::ordered_json{{"name", names[c]}, {"title", exhibit.table.columns[c].title}});
  for (const std::vector<Cell>& cells : exhibit.table.rows) {
    nlohmann::ordered_json row = nlohmann::ordered_json::array();
    for (const Cell& cell : cells) {
      if (isText(cell))
        row.push_back(std::get<std::string>(cell));
      else if (std::isfinite(std::get<double>(cell)))
        row.push_back(std::get<double>(cell));
      else
        row.push_back(nullptr);
    }
    json["rows"].push_back(row);
  }
  return json.dump(1, ' ', false, nlohmann::json::error_handler_t::replace) + "\n";
}

}  // namespace palpa::report
