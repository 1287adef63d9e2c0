#pragma once

#include <string>
#include <vector>

/// Numbers and lists in sentences, the same in every locale.
namespace palpa::study_analysis {

std::string number(double value, int decimals);  ///< "-3.5"; "–" for what is none
std::string percent(double share);               ///< 0.314 as "31 %"
std::string pWords(double p);                    ///< "p = 0.012", "p < 0.001"
std::string joined(const std::vector<std::string>& parts,
                   const std::string& last = " and ");       ///< "a, b and c"
std::string counted(std::size_t n, const std::string& one);  ///< "1 subject", "5 subjects"
std::string capitalised(std::string text);  ///< its first letter, where it is of the Latin alphabet
int decimalsFor(double value);              ///< so that three digits or more are seen
void addOnce(std::vector<std::string>& list, const std::string& text);

}  // namespace palpa::study_analysis
