#include "apps/language/shelf.h"

#include <algorithm>
#include <nlohmann/json.hpp>

#include "apps/language/pseudo.h"

namespace palpa::language {

std::shared_ptr<const Spoken> Shelf::of(const std::string& code) {
  const std::lock_guard lock(mutex_);
  auto& one = read_[code];
  if (one) return one;
  try {
    return one = std::make_shared<const Spoken>(languageOf(folder_, code));
  } catch (...) {
    read_.erase(code);
    throw;
  }
}

std::string Shelf::best(const std::string& chosen, std::string_view accepted) const {
  if (chosen == kPseudo || chosen == kPseudoFromRight) return chosen;
  const std::vector<Language> all = this->all();
  const auto isOurs = [&](std::string_view code) {
    return std::any_of(all.begin(), all.end(), [&](const Language& l) { return l.code == code; });
  };
  if (isOurs(chosen)) return chosen;
  while (!accepted.empty()) {
    std::string_view one = accepted.substr(0, accepted.find(','));
    accepted.remove_prefix(std::min(accepted.size(), one.size() + 1));
    one.remove_prefix(std::min(one.find_first_not_of(' '), one.size()));
    one = one.substr(0, one.find_first_of("; "));
    for (const std::string_view code : {one, one.substr(0, one.find('-'))})
      if (isOurs(code)) return std::string(code);
  }
  return "en";
}

std::string Shelf::catalogueJson(const std::string& code) const {
  const Catalogue catalogue = catalogueOf(folder_, code);
  nlohmann::json messages = nlohmann::json::array();
  for (const PoFile::Message& one : catalogue.messages)
    if (!one.translation.empty()) messages.push_back({one.id, one.translation});
  const nlohmann::json all{{"code", catalogue.code},           {"name", catalogue.name},
                           {"reviewed", catalogue.reviewed},   {"fromRight", catalogue.from_right},
                           {"point", catalogue.numbers.point}, {"group", catalogue.numbers.group},
                           {"messages", std::move(messages)}};
  return all.dump(-1, ' ', false, nlohmann::json::error_handler_t::replace);
}

}  // namespace palpa::language
