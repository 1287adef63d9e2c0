#pragma once

#include <string>

/// What a trainee says of something that was felt.
namespace palpa::trial {

/// A grade as it is recorded in an event's text, and read again: "diameter 16 mm, hard, fixed";
/// nothing for words that are none.
std::string gradeText(double diameter, int hardness, int mobility);
struct Grade {
  double diameter = 0;
  int hardness = 0, mobility = 0;
};
Grade gradeOf(const std::string& text);

}  // namespace palpa::trial
