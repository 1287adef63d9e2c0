#pragma once

#include <initializer_list>
#include <string>
#include <string_view>
#include <vector>

#include "apps/report/html.h"
#include "apps/report/session_report.h"

/// What the page of any session is made of, besides its trials.
namespace palpa::report {

/// <head> with title ("Paracentesis · P07") and style sheet; `more_style` is CSS of a page's own.
void writeHeadElement(Html& html, const std::string& title, const std::string& trainee,
                      std::string_view more_style = {});

/// Trainee, date, number of trials; what is empty is left out.
void writeWho(Html& html, const std::string& trainee, const std::string& when, std::size_t trials);

/// "SIMULATED", on top of a page whose operator or bench is.
void writeSimulatedBanner(Html& html);

/// Name, value and remark, one fact a row; nothing where there are none.
void writeFactTable(Html& html, const std::vector<Fact>& facts);
/// The same in a card with a title.
void writeFacts(Html& html, const char* title, const std::vector<Fact>& facts);

/// "Made by ...": from the first fact named "software" or "software version", in whatever group it
/// stands.
void writeMadeBy(Html& html, std::initializer_list<const std::vector<Fact>*> groups);

}  // namespace palpa::report
