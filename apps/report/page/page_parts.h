#pragma once

#include <cstdint>
#include <functional>
#include <initializer_list>
#include <string>
#include <string_view>
#include <vector>

#include "apps/report/page/html.h"
#include "apps/report/page/pictures.h"

/// What the page of any session is made of, besides its trials.
namespace palpa::report {

/// A figure with its name, for tables of facts ("Registration error at the entry point, median":
/// "0.4 mm").
struct Fact {
  std::string name, value, remark;
};

/// Calls `draw` with what a trial's charts are drawn from, trial by trial in the order of their
/// numbers: only one trial's samples are then in memory. Throws Error.
template <class Sample>
using Courses =
    std::function<void(const std::function<void(int trial, const std::vector<Sample>&)>& draw)>;

/// Calls `write` with every page, in order: with its samples from `courses`, where they are given.
/// A trial that is not among them has none. `number` tells a page's trial.
template <class Page, class Sample, class Number, class Write>
void eachPage(const std::vector<Page>& pages, const Courses<Sample>& courses, const Number& number,
              const Write& write) {
  auto next = pages.begin();
  if (courses)
    courses([&](int trial, const std::vector<Sample>& samples) {
      while (next != pages.end() && number(*next) < trial) write(*next++);
      if (next == pages.end() || number(*next) != trial) return;
      Page page = *next++;
      page.samples = samples;
      write(page);
    });
  while (next != pages.end()) write(*next++);
}

/// <head> with title ("Subclavian access · P07") and style sheet; `more_style` is CSS of a page's
/// own.
void writeHeadElement(Html& html, const std::string& title, const std::string& trainee,
                      std::string_view more_style = {});

/// Trainee, date, number of trials; what is empty is left out.
void writeWho(Html& html, const std::string& trainee, const std::string& when, std::size_t trials);

/// "SIMULATED", on top of a page whose operator or bench is.
void writeSimulatedBanner(Html& html);

/// Name, value and remark, one fact a row; nothing where there is none.
void writeFactTable(Html& html, const std::vector<Fact>& facts);
/// The same in a card with a title.
void writeFacts(Html& html, const char* title, const std::vector<Fact>& facts);

/// "Made by ...": from the first fact named "software" or "software version", in whatever group it
/// stands.
void writeMadeBy(Html& html, std::initializer_list<const std::vector<Fact>*> groups);

/// The figures behind a plot: closed until asked for, the first column names the rows. On paper it
/// stays closed.
struct DataTable {
  std::string title;  ///< "The figures of this plot"
  std::vector<std::string> columns;
  std::vector<std::vector<std::string>> rows;  ///< as long as `columns`
  std::size_t words_from = SIZE_MAX;           ///< from this column on they are words, not figures
};
void writeDataTable(Html& html, const DataTable& table);

/// The same always open.
void writeOpenTable(Html& html, const DataTable& table);

/// Shortest digits that read back to the same bits; for files.
std::string shortest(double value);

/// For people: `decimals` places, true minus sign, thin spaces between thousands (from 10 000 on),
/// "–" for what is no number. `fixed(-12345.67, 1)` is "−12 345.7".
std::string fixed(double value, int decimals);

/// As `fixed`, but trailing zeros after the point are left out: 7, 18.5, 0.25.
std::string trimmed(double value, int decimals);

/// For coordinates in SVG: at most one decimal, ASCII, never an exponent.
std::string coordinate(double value);

}  // namespace palpa::report
