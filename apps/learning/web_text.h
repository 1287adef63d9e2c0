#pragma once

#include <string>
#include <utility>
#include <vector>

namespace palpa::learning {

/// Fields in their order: of an address's query, of a form.
using Fields = std::vector<std::pair<std::string, std::string>>;

/// "a=b&c=d": RFC 3986, all but letters, digits and "-._~" as %XX.
std::string queryOf(const Fields& fields);

/// An address with more in its query.
std::string withQuery(const std::string& url, const Fields& fields);

/// The value of a field; empty where it is missing. Throws UsageError where it comes twice.
std::string fieldIn(const Fields& fields, const std::string& name);
/// The same; throws UsageError where it is missing, or longer than `most`.
std::string neededIn(const Fields& fields, const std::string& name, std::size_t most = 2'000);

/// A page of a few words that needs nothing else: HTML, with what has a meaning there escaped.
/// `back`: an address of the course; empty: there is no link.
std::string pageOfWords(const std::string& title, const std::string& words,
                        const std::string& back = "");

}  // namespace palpa::learning
