#pragma once

#include <string>
#include <variant>
#include <vector>

namespace palpa::study_analysis {

/// How the numbers of a column are to be read.
enum class Format { number, p_value };

struct Column {
  std::string name;   ///< in files: "mean_first"; never changes its meaning
  std::string title;  ///< for readers: "Mean, first two"
  int decimals = 1;
  Format format = Format::number;
  bool page = true;  ///< false: in files only, the page would be too wide
};

using Cell = std::variant<std::string, double>;  ///< not a number: does not apply

struct Table {
  std::vector<Column> columns;
  std::vector<std::vector<Cell>> rows;
};

struct PlotPoint {
  double x = 0, y = 0;
  double low = 0, high = 0;  ///< 95 % interval; equal where there is none
};

struct PlotSeries {
  std::string label;
  int family = 0;  ///< of like colour, dash and shape: condition, group
  std::vector<PlotPoint> points;
};

enum class PlotKind {
  curves,  ///< means over trials with bands
  bars,    ///< x: 0, 1, ... named by x_names; a series a colour
  slopes,  ///< before and after, a line a subject, a panel a family
  scatter  ///< a point a subject
};

/// A vertical line with the name of what begins there.
struct PlotDivider {
  double x = 0;
  std::string label;
};

struct Plot {
  PlotKind kind = PlotKind::curves;
  std::string x_title, y_title;
  std::vector<std::string> x_names, families;  ///< families: what a colour stands for
  std::vector<PlotSeries> series;
  std::vector<PlotDivider> dividers;
};

enum class ExhibitPart { figure, table, check, published };

/// A table or figure of the results, with what is to be said of it; a figure has its numbers as a
/// table, too.
struct Exhibit {
  std::string id;  ///< "table_3": names its files
  std::string title, caption;
  ExhibitPart part = ExhibitPart::table;
  Table table;
  std::vector<Plot> plots;
  std::vector<std::string> notes;  ///< assumptions in doubt, who was left out
};

/// What a study found, in the order in which it is read.
struct StudyResult {
  std::string title, kind;
  std::vector<std::string> groups, conditions;
  std::size_t subjects = 0, trials = 0, simulated_trials = 0;
  std::vector<std::string> software;
  std::vector<std::string> findings;  ///< plain sentences, most important first
  std::vector<Exhibit> exhibits;
  std::vector<std::string> cautions;  ///< what cannot be said, and why
  /// Why the figures after the published way are not to be trusted; empty: not asked for
  std::vector<std::string> published_words;
};

}  // namespace palpa::study_analysis

/// Numbers and lists in sentences, the same in every locale.
namespace palpa::study_analysis {

std::string number(double value, int decimals);  ///< "-3.5"; "–" for what is none
std::string percent(double share);               ///< 0.314 as "31 %"
std::string pWords(double p);                    ///< "p = 0.012", "p < 0.001"
std::string joined(const std::vector<std::string>& parts,
                   const std::string& last = " and ");  ///< "a, b and c"
std::string capitalised(std::string text);  ///< its first letter, where it is of the Latin alphabet
int decimalsFor(double value);              ///< so that three digits or more are seen
void addOnce(std::vector<std::string>& list, const std::string& text);

}  // namespace palpa::study_analysis
