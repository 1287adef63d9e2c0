#include "apps/report/paper/rating_form.h"

#include "anatomy/base/whole_file.h"
#include "apps/report/page/html.h"
#include "apps/report/page/page_parts.h"

namespace palpa::report {
namespace {

constexpr std::string_view kPaper = R"css(
:root{color-scheme:light;--page:#fff;--card:#fff;--ink:#111;--muted:#555;--line:#999;--faint:#6b7280}
@media (prefers-color-scheme:dark){:root{--page:#fff;--card:#fff;--ink:#111;--muted:#555;--line:#999}}
.paper{max-width:794px;padding-top:24px;padding-bottom:24px}
.paper h1{font-size:1.35rem}
.paper h2{font-size:1.1rem;margin:1.6rem 0 .5rem}
.lines{display:grid;grid-template-columns:1fr 1fr;gap:.9rem 2rem;margin:1rem 0}
.lines span{border-bottom:1px solid var(--ink);padding-bottom:.1rem;min-height:1.6rem}
.lines em{font-style:normal;color:var(--muted);margin-right:.5rem}
.form{width:100%;border-collapse:collapse;font-size:.875rem}
.form th{font-weight:600;text-align:left;border-bottom:1.5px solid var(--ink);padding:.2rem .3rem}
.form td{border-bottom:1px solid var(--line);padding:.28rem .3rem;vertical-align:top}
.form .box{width:4.2rem;text-align:center}
.form .box i{display:inline-block;width:.95rem;height:.95rem;border:1.3px solid var(--ink);vertical-align:middle}
.form code{font-size:.8rem;color:var(--muted)}
.form .faint{color:var(--faint);font-size:.75rem}
.grades .box{width:2.2rem}
.grades .words{font-size:.78rem;width:50%}
.free{border:1px solid var(--line);height:5.5rem;margin:.4rem 0 1rem}
@media (max-width:719px){.form .box{width:2.6rem}.lines{grid-template-columns:1fr}}
@media print{@page{size:A4;margin:12mm}html{font-size:12px}.paper{padding:0}.form tr{break-inside:avoid}.grades-part{break-inside:avoid}.form .box{width:3.4rem}.grades .box{width:2.2rem}}
)css";

void writeLine(Html& html, const char* name, const std::string& value) {
  const auto line = html.in("span");
  html.element("em", name);
  html.text(value);
}

void writeHead(Html& html, const RatingForm& form) {
  const auto lines = html.in("div", {{"class", "lines"}});
  writeLine(html, "Trainee (pseudonym)", form.trainee + (form.simulated ? " (simulated)" : ""));
  writeLine(html, "Rater (pseudonym)", "");
  writeLine(html, "Date", form.when);
  writeLine(html, "Trial", form.trial ? std::to_string(form.trial) : "");
  writeLine(html, "Session", form.session);
  writeLine(html, "Signature", "");
}

void writeBox(Html& html) {
  const auto cell = html.in("td", {{"class", "box"}});
  html.element("i", "");
}

std::string saidBySimulator(const RatingForm& form, const competence::ChecklistItem& item) {
  for (const competence::MarkedItem& m : form.marks) {
    if (m.item != &item || item.byRater() || m.mark == competence::Mark::open) continue;
    return std::string("simulator: ") + competence::markWords(m.mark) +
           (m.why.empty() || m.mark == competence::Mark::done ? "" : ", " + m.why);
  }
  return "";
}

void writeItems(Html& html, const RatingForm& form) {
  html.element("h2", form.checklist->title);
  html.element("p", {{"class", "small"}},
               "Mark one box for each item. Bold items are major. Judge what you saw, whatever "
               "the simulator says.");
  const auto table = html.in("table", {{"class", "form"}});
  {
    const auto row = html.in("tr");
    html.element("th", "Item");
    for (const char* title : {"done", "not done", "did not arise"})
      html.element("th", {{"class", "box"}}, title);
  }
  for (const competence::ChecklistItem& item : form.checklist->items) {
    const auto row = html.in("tr");
    {
      const auto cell = html.in("td");
      html.element(item.major ? "strong" : "span", item.text);
      html.raw(" ");
      html.element("code", item.id);
      if (const std::string said = saidBySimulator(form, item); !said.empty()) {
        const auto faint = html.in("div", {{"class", "faint"}});
        html.text(said);
      }
    }
    for (int i = 0; i < 3; ++i) writeBox(html);
  }
}

void writeGrades(Html& html, const competence::GlobalRating& global) {
  const auto part = html.in("div", {{"class", "grades-part"}});
  html.element("h2", global.title);
  const auto table = html.in("table", {{"class", "form grades"}});
  {
    const auto row = html.in("tr");
    html.element("th", "Aspect");
    for (const char* grade : {"1", "2", "3", "4", "5"})
      html.element("th", {{"class", "box"}}, grade);
    html.element("th", "Words for 1, 3 and 5");
  }
  for (const competence::RatingItem& item : global.items) {
    const auto row = html.in("tr");
    {
      const auto cell = html.in("td");
      html.element("strong", item.text);
      html.raw(" ");
      html.element("code", item.id);
    }
    for (int i = 0; i < competence::kBestGrade; ++i) writeBox(html);
    html.element("td", {{"class", "words"}},
                 "1: " + item.low + ". 3: " + item.middle + ". 5: " + item.high + ".");
  }
}

}  // namespace

void writeRatingForm(const RatingForm& form, const std::filesystem::path& file) {
  Html html;
  html.raw("<!doctype html>\n");
  {
    const auto root = html.in("html", {{"lang", "en"}});
    writeHeadElement(html, "Rating form", form.trainee, kPaper);
    const auto body = html.in("body");
    const auto main = html.in("main", {{"class", "paper"}});
    html.element("h1", "Rating of a needle procedure");
    if (form.simulated) writeSimulatedBanner(html);
    writeHead(html, form);
    writeItems(html, form);
    if (form.global) writeGrades(html, *form.global);
    html.element("h2", "Remarks");
    html.element("div", {{"class", "free"}}, "");
    html.element("p", {{"class", "small muted"}},
                 form.checklist->source + (form.global ? ". " + form.global->source : "") + ".");
  }
  writeWhole(file, html.page());
}

std::string answerSheet(const competence::Checklist& checklist,
                        const competence::GlobalRating* global) {
  std::string text = "item,value\n# done, not done or did not arise:\n";
  for (const competence::ChecklistItem& item : checklist.items) text += item.id + ",\n";
  if (!global) return text;
  text += "# 1 to 5:\n";
  for (const competence::RatingItem& item : global->items) text += item.id + ",\n";
  return text;
}

}  // namespace palpa::report
