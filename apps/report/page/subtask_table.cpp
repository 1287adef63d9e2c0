#include "apps/report/page/subtask_table.h"

#include <algorithm>

#include "apps/report/page/page_parts.h"

namespace palpa::report {
namespace {

constexpr std::string_view kSubtaskStyle = R"css(
.parts{border-collapse:collapse;width:100%;font-size:.9rem;margin:0 0 1rem}
.parts th,.parts td{text-align:right;vertical-align:top;padding:.45rem 0 .45rem 1.1rem;border-bottom:1px solid var(--line);white-space:nowrap}
.parts thead th{font-weight:400;color:var(--muted);vertical-align:bottom;white-space:normal}
.parts th:first-child{text-align:left;padding-left:0;min-width:11rem;white-space:normal;font-weight:600}
.parts thead th:first-child{font-weight:400}
.parts th span{display:block;font-weight:400;color:var(--muted);font-size:.875rem}
)css";

std::string meaningOf(const SubtaskMeanings& meanings, const std::string& subtask) {
  const auto at = std::find_if(meanings.begin(), meanings.end(),
                               [&](const auto& meaning) { return meaning.first == subtask; });
  return at == meanings.end() ? "" : at->second;
}

std::string shareText(double part, double of) {
  return of > 0 ? fixed(100 * part / of, 0) + " %" : "–";
}

void writeSubtaskRow(Html& html, const assess::SubtaskDose& dose, const std::string& meaning,
                     double seconds, bool cues) {
  const auto row = html.in("tr");
  {
    const auto cell = html.in("th", {{"scope", "row"}});
    html.text(dose.subtask);
    if (!meaning.empty()) html.element("span", meaning);
  }
  html.element("td", fixed(dose.on_s, 1) + " s");
  html.element("td", shareText(dose.on_s, seconds));
  html.element("td", std::to_string(dose.occasions));
  if (!cues) return;
  const bool any = dose.augmented_s > 0;
  html.element("td", any ? fixed(dose.augmented_s, 1) + " s" : "none");
  html.element("td", any ? fixed(dose.impulse_Ns, 2) + " N s" : "none");
  html.element("td", any ? fixed(dose.impulse_Ns / dose.augmented_s, 2) + " N" : "–");
}

}  // namespace

std::vector<assess::SubtaskDose> dosesSummed(
    const std::vector<std::vector<assess::SubtaskDose>>& trials) {
  std::vector<assess::SubtaskDose> sums;
  for (const std::vector<assess::SubtaskDose>& doses : trials) {
    for (const assess::SubtaskDose& dose : doses) {
      auto sum = std::find_if(sums.begin(), sums.end(), [&](const assess::SubtaskDose& s) {
        return s.subtask == dose.subtask;
      });
      if (sum == sums.end()) sum = sums.insert(sums.end(), {dose.subtask, 0, 0, 0, 0});
      sum->on_s += dose.on_s;
      sum->times += dose.times;
      sum->occasions += dose.occasions;
      sum->augmented_s += dose.augmented_s;
      sum->impulse_Ns += dose.impulse_Ns;
    }
  }
  return sums;
}

void writeSubtaskTable(Html& html, const std::vector<assess::SubtaskDose>& doses,
                       const SubtaskMeanings& meanings, double seconds) {
  if (doses.empty()) return;
  const bool cues = std::any_of(doses.begin(), doses.end(), [](const assess::SubtaskDose& dose) {
    return dose.augmented_s > 0;
  });
  const auto scroll = html.in("div", {{"class", "scroll"}, {"tabindex", "0"}});
  const auto table = html.in("table", {{"class", "parts"}});
  {
    const auto head = html.in("thead");
    const auto row = html.in("tr");
    for (const char* column : {"Part of the task", "Lasted", "Of the trial", "Times"})
      html.element("th", {{"scope", "col"}}, column);
    if (cues)
      for (const char* column : {"Cues felt", "Added in all", "Added on average"})
        html.element("th", {{"scope", "col"}}, column);
  }
  const auto body = html.in("tbody");
  for (const assess::SubtaskDose& dose : doses)
    if (dose.subtask != assess::kAnyPart || dose.augmented_s > 0)
      writeSubtaskRow(html, dose, meaningOf(meanings, dose.subtask), seconds, cues);
}

void writeSubtaskNote(Html& html) {
  html.element(
      "p", {{"class", "muted small"}},
      "Lasted: while the hand did that part of the task, by its place, its speed and its "
      "contact; parts may overlap. Times: what was left for less than a quarter of a second "
      "counts once. Cues felt: while a cue was pushing; no such column "
      "where none was. Added in all: force times time, 1 N s is one "
      "newton for one second. Added on average: while a cue was felt.");
}

void writeSubtaskSection(Html& html, const SubtaskSection& parts) {
  const std::vector<assess::SubtaskDose> sums = dosesSummed(parts.trials);
  if (sums.empty()) return;
  const auto section = html.in("section", {{"class", "card"}, {"id", "parts"}});
  html.element("h2", "The parts of the task, and what the cues added");
  const std::size_t all = parts.trials.size();
  html.element("p", parts.augmented == 0
                        ? std::string("No cues were added to the forces.")
                        : "In " + std::to_string(parts.augmented) + " of " + std::to_string(all) +
                              (all == 1 ? " trial" : " trials") +
                              " cues were added to the forces: what was felt is then more than the "
                              "tissue's own.");
  writeSubtaskTable(html, sums, parts.meanings, parts.seconds);
  writeSubtaskNote(html);
}

std::string_view subtaskTableStyle() { return kSubtaskStyle; }

namespace {

/// "shape assessment" -> "SHAPE_ASSESSMENT".
std::string columnName(const std::string& subtask) {
  std::string column;
  for (const char c : subtask) {
    const bool small = c >= 'a' && c <= 'z',
               plain_character = (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9');
    column += small ? static_cast<char>(c - 'a' + 'A') : plain_character ? c : '_';
  }
  return column;
}

}  // namespace

std::string subtaskColumns(const std::vector<assess::SubtaskDose>& parts) {
  std::string columns;
  for (const assess::SubtaskDose& part : parts)
    for (const char* what : {"_ON_S", "_TIMES", "_AUGMENTED_S", "_IMPULSE_NS"})
      columns += ',' + columnName(part.subtask) + what;
  return columns;
}

std::string subtaskFields(const std::vector<assess::SubtaskDose>& parts,
                          const std::vector<assess::SubtaskDose>& doses) {
  std::string fields;
  for (const assess::SubtaskDose& part : parts) {
    const auto dose = std::find_if(doses.begin(), doses.end(), [&](const assess::SubtaskDose& d) {
      return d.subtask == part.subtask;
    });
    fields += dose == doses.end()
                  ? ",,,,"
                  : ',' + shortest(dose->on_s) + ',' + std::to_string(dose->times) + ',' +
                        shortest(dose->augmented_s) + ',' + shortest(dose->impulse_Ns);
  }
  return fields;
}

}  // namespace palpa::report
