#include "apps/study_analysis/comparison.h"

#include <boost/math/distributions/students_t.hpp>
#include <cmath>

#include "anatomy/geometry/error.h"
#include "apps/assess/statistics/assumptions.h"
#include "apps/assess/statistics/bootstrap.h"
#include "apps/assess/statistics/holm.h"
#include "apps/assess/statistics/t_test.h"

namespace palpa::study_analysis {
namespace {

using statistics::Samples;

/// The sentence of an Error without the place where it came from.
std::string reasonOf(const Error& e) {
  const std::string text = e.what();
  const std::size_t from = text.find(": ");
  return from == std::string::npos ? text : text.substr(from + 2);
}

void fill(Comparison& c, const statistics::TTest& t) {
  c.difference = t.difference;
  c.low = t.low;
  c.high = t.high;
  c.t = t.t;
  c.degrees = t.degrees;
  c.effect = t.effect;
}

std::vector<double> differencesOf(const std::vector<double>& a, const std::vector<double>& b) {
  std::vector<double> d;
  for (std::size_t i = 0; i < a.size(); ++i) d.push_back(a[i] - b[i]);
  return d;
}

/// Pairs are drawn as pairs: of their differences.
void resample(Comparison& c, const std::vector<double>& a, const std::vector<double>& b,
              std::uint64_t seed) {
  const statistics::BootstrapSettings settings{2000, 0.95, seed};
  const Samples samples = c.test == Test::paired ? Samples{differencesOf(a, b)} : Samples{a, b};
  const statistics::BootstrapInterval interval = statistics::bootstrap(
      samples,
      [](const Samples& s) {
        return statistics::meanOf(s[0]) - (s.size() > 1 ? statistics::meanOf(s[1]) : 0);
      },
      settings);
  c.boot_low = interval.low;
  c.boot_high = interval.high;
}

std::vector<std::string> concernsOf(const Comparison& c, const std::vector<double>& a,
                                    const std::vector<double>& b) {
  if (c.test == Test::welch) return statistics::concernsAbout({a, b}, {c.a_name, c.b_name});
  return statistics::concernsAbout({differencesOf(a, b)}, {c.a_name + " less " + c.b_name});
}

Comparison started(Test test, const std::vector<double>& a, const std::vector<double>& b,
                   const std::string& a_name, const std::string& b_name) {
  Comparison c;
  c.test = test;
  c.a_name = a_name;
  c.b_name = b_name;
  c.a = statistics::describe(a);
  c.b = statistics::describe(b);
  return c;
}

}  // namespace

Comparison compare(Test test, const std::vector<double>& a, const std::vector<double>& b,
                   const std::string& a_name, const std::string& b_name, std::uint64_t seed) {
  Comparison c = started(test, a, b, a_name, b_name);
  try {
    const statistics::TTest t =
        test == Test::paired ? statistics::paired(a, b) : statistics::welch(a, b);
    fill(c, t);
    c.p = t.p_two_sided;
    resample(c, a, b, seed);
    c.concerns = concernsOf(c, a, b);
  } catch (const Error& e) {
    c.not_tested = reasonOf(e);
  }
  return c;
}

Comparison compareAsPublished(const std::vector<double>& a, const std::vector<double>& b,
                              const std::string& a_name, const std::string& b_name) {
  Comparison c = started(Test::welch, a, b, a_name, b_name);
  try {
    const statistics::TTest t = statistics::welch(a, b);
    fill(c, t);
    c.p = t.p_less;
  } catch (const Error& e) {
    c.not_tested = reasonOf(e);
  }
  return c;
}

void correctTogether(const std::vector<Comparison*>& family) {
  std::vector<double> p;
  for (const Comparison* c : family)
    if (c->tested()) p.push_back(c->p);
  const std::vector<double> corrected = statistics::holm(p);
  std::size_t i = 0;
  for (Comparison* c : family)
    if (c->tested()) c->p_holm = corrected[i++];
}

PlotPoint meanPoint(double x, const std::vector<double>& values) {
  const statistics::Description d = statistics::describe(values);
  constexpr double kNone = std::numeric_limits<double>::quiet_NaN();
  if (d.n < 2) return {x, d.mean, kNone, kNone};  // of one nothing is known about the next
  const double n = static_cast<double>(d.n),
               half = d.sd / std::sqrt(n) *
                      boost::math::quantile(boost::math::students_t(n - 1), 0.975);
  return {x, d.mean, d.mean - half, d.mean + half};
}

}  // namespace palpa::study_analysis
