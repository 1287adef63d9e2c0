#include "apps/language/languages.h"

#include <algorithm>
#include <cstdlib>
#include <nlohmann/json.hpp>

#include "anatomy/base/error.h"
#include "anatomy/base/nearest_word.h"
#include "anatomy/base/whole_file.h"
#include "apps/language/po_file.h"

namespace palpa::language {
namespace {

namespace fs = std::filesystem;
constexpr char kEnglish[] = "en";

std::string textOf(const fs::path& file) {
  if (auto text = readWhole(file)) return *std::move(text);
  throw Error("cannot be read", file.string(), "Install palpa again");
}

std::string valueIn(const PoFile& po, const char* name, const std::string& otherwise = "") {
  const auto found = po.header.find(name);
  return found == po.header.end() ? otherwise : found->second;
}

Language english() { return {kEnglish, "English", true, false}; }

Language headOf(const PoFile& po, const std::string& code) {
  return {code, valueIn(po, "X-Name", code), valueIn(po, "X-Reviewed") == "yes",
          valueIn(po, "X-Direction") == "rtl"};
}

Catalogue fromFile(const fs::path& file) {
  PoFile po = readPo(textOf(file), file.string());
  const NumberForm numbers{valueIn(po, "X-Decimal-Mark", "."), valueIn(po, "X-Group-Mark", ",")};
  return {headOf(po, file.stem().string()), numbers, std::move(po.messages)};
}

Catalogue pseudo(const fs::path& folder, const std::string& code) {
  const fs::path file = folder / "palpa.pot";
  return {{code, "Pseudo", false, code == kPseudoFromRight},
          {",", "."},
          pseudoMessages(readPo(textOf(file), file.string()))};
}

/// "el_GR.UTF-8@x" -> "el"
std::string codeOf(std::string locale) {
  locale.resize(std::min(locale.find_first_of(".@"), locale.size()));
  std::replace(locale.begin(), locale.end(), '_', '-');
  return locale;
}

bool isIn(const std::vector<Language>& all, const std::string& code) {
  return std::any_of(all.begin(), all.end(), [&](const Language& one) { return one.code == code; });
}

struct OfProcess {
  Spoken spoken{english(), {}}, written{english(), {}};
};
OfProcess& ofProcess() {
  static OfProcess languages;
  return languages;
}

}  // namespace

std::vector<Language> languagesIn(const fs::path& folder) {
  std::vector<Language> all{english()};
  std::error_code none;
  for (const auto& entry : fs::directory_iterator(folder, none))
    if (entry.path().extension() == ".po")
      all.push_back(headOf(readPo(textOf(entry.path()), entry.path().string()),
                           entry.path().stem().string()));
  std::sort(all.begin(), all.end(), [](const auto& a, const auto& b) { return a.code < b.code; });
  return all;
}

Catalogue catalogueOf(const fs::path& folder, const std::string& code) {
  if (code == kEnglish) return {english(), {}, {}};
  if (code == kPseudo || code == kPseudoFromRight) return pseudo(folder, code);
  const std::vector<Language> all = languagesIn(folder);
  if (isIn(all, code)) return fromFile(folder / (code + ".po"));
  std::string known;
  for (const Language& one : all) known += (known.empty() ? "" : ", ") + one.code;
  throw UsageError("is no language of this program", "\"" + code + "\"", "Known: " + known);
}

Spoken languageOf(const fs::path& folder, const std::string& code) {
  if (code == kEnglish) return {english(), {}};
  const Catalogue catalogue = catalogueOf(folder, code);
  return {catalogue, Phrasebook(catalogue.messages, catalogue.numbers)};
}

std::string wishedLanguage(const fs::path& folder, const std::string& given) {
  if (!given.empty()) return given;
  for (const char* name : {"LANGUAGE", "LC_ALL", "LC_MESSAGES", "LANG"}) {
    const char* value = std::getenv(name);
    if (!value || !*value) continue;
    std::string first(value);
    first.resize(std::min(first.find(':'), first.size()));
    const std::string code = codeOf(first);
    const std::string language = code.substr(0, code.find('-'));
    const std::vector<Language> all = languagesIn(folder);
    for (const std::string& one : {code, language})
      if (isIn(all, one)) return one;
    if (std::string_view(name) != "LANGUAGE") break;  // the first that is set decides
  }
  return kEnglish;
}

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

const Spoken& spoken() { return ofProcess().spoken; }
const Spoken& written() { return ofProcess().written; }
void speak(Spoken language) { ofProcess().spoken = std::move(language); }
void write(Spoken language) { ofProcess().written = std::move(language); }

}  // namespace palpa::language
