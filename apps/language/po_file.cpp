#include "apps/language/po_file.h"

#include <algorithm>

#include "anatomy/base/error.h"
#include "apps/language/phrase.h"

namespace palpa::language {
namespace {

constexpr char kGuide[] = "\"guide\"";
constexpr char kMend[] = "Look at it with an editor for PO files, or with msgfmt --check";

class Reader {
 public:
  Reader(std::string_view text, const std::string& name) : rest_(text), name_(name) {}

  PoFile read() {
    while (!rest_.empty()) take(nextLine());
    if (of_the_guide_ && !has_id_) refuse("ends with a context");
    keep();
    return std::move(file_);
  }

 private:
  std::string_view nextLine() {
    ++number_;
    const std::size_t end = rest_.find('\n');
    std::string_view line = rest_.substr(0, end);
    rest_.remove_prefix(end == std::string_view::npos ? rest_.size() : end + 1);
    if (line.ends_with('\r')) line.remove_suffix(1);
    return line;
  }

  void take(std::string_view line) {
    if (line.empty() || line.starts_with("#~")) return;
    if (of_the_guide_ && !has_id_ && !line.starts_with("msgid \""))
      refuse("has a context without a message");
    if (line.starts_with("#,") && line.find("fuzzy") != std::string_view::npos) {
      keep();
      fuzzy_ = true;
    } else if (line.starts_with('#')) {
      return;
    } else if (line.starts_with("msgctxt ")) {
      if (line.substr(8) != kGuide) refuse("has a context that is not the guide's");
      keep();
      of_the_guide_ = true;
    } else if (line.starts_with("msgid \"")) {
      if (has_id_) keep();
      into_ = &now_.id;
      has_id_ = true;
      add(line.substr(6));
    } else if (line.starts_with("msgstr \"") && has_id_) {
      into_ = &now_.translation;
      add(line.substr(7));
    } else if (line.starts_with('"') && into_) {
      add(line);
    } else {
      refuse("holds what is neither a message nor its translation");
    }
  }

  void add(std::string_view quoted) {
    if (quoted.size() < 2 || !quoted.ends_with('"')) refuse("lacks a quotation mark");
    quoted = quoted.substr(1, quoted.size() - 2);
    for (std::size_t i = 0; i < quoted.size(); ++i) {
      if (quoted[i] == '"') refuse("has a quotation mark within a text");
      if (quoted[i] != '\\') {
        *into_ += quoted[i];
        continue;
      }
      if (++i == quoted.size()) refuse("ends with half a character");
      *into_ += plain(quoted[i]);
    }
  }

  char plain(char escaped) {
    switch (escaped) {
      case 'n':
        return '\n';
      case 't':
        return '\t';
      case '"':
      case '\\':
        return escaped;
      default:
        refuse("has a character after \\ that means nothing");
    }
  }

  void keep() {
    if (has_id_ && now_.id.empty())
      readHeader(now_.translation);
    else if (has_id_)
      (of_the_guide_ ? file_.of_the_guide : file_.messages)
          .push_back({now_.id, fuzzy_ ? "" : now_.translation});
    if (has_id_) fuzzy_ = of_the_guide_ = false;
    now_ = {};
    into_ = nullptr;
    has_id_ = false;
  }

  void readHeader(std::string_view text) {
    while (!text.empty()) {
      const std::size_t end = text.find('\n'), colon = text.find(':');
      if (colon < end) {
        std::string_view value = text.substr(colon + 1, end - colon - 1);
        if (value.starts_with(' ')) value.remove_prefix(1);
        file_.header[std::string(text.substr(0, colon))] = std::string(value);
      }
      text.remove_prefix(end == std::string_view::npos ? text.size() : end + 1);
    }
  }

  [[noreturn]] void refuse(const char* what) const {
    throw UsageError(what, name_ + ", line " + std::to_string(number_), kMend);
  }

  std::string_view rest_;
  const std::string& name_;
  int number_ = 0;
  PoFile file_;
  PoFile::Message now_;
  std::string* into_ = nullptr;
  bool has_id_ = false, fuzzy_ = false, of_the_guide_ = false;
};

}  // namespace

PoFile readPo(std::string_view text, const std::string& name) { return Reader(text, name).read(); }

namespace {

/// DejaVu Sans has all of these.
constexpr std::string_view kSmall[] = {"á", "ƀ", "ç", "đ", "é", "ƒ", "ĝ", "ĥ", "í",
                                       "ĵ", "ķ", "ł", "ɱ", "ñ", "ó", "ƥ", "ɋ", "ř",
                                       "š", "ŧ", "ú", "ʋ", "ŵ", "ẋ", "ý", "ž"};
constexpr std::string_view kLarge[] = {"Á", "Ƀ", "Ç", "Đ", "É", "Ƒ", "Ĝ", "Ĥ", "Í",
                                       "Ĵ", "Ķ", "Ł", "Ɱ", "Ñ", "Ó", "Ƥ", "Ɋ", "Ř",
                                       "Š", "Ŧ", "Ú", "Ʋ", "Ŵ", "Ẋ", "Ý", "Ž"};

/// Vowels twice until the text is a third longer.
std::string marked(const std::string& id) {
  const auto letters = std::count_if(id.begin(), id.end(), isLetter);
  long more = (letters + 2) / 3;
  std::string out;
  for (const char c : id) {
    if (!isLetter(c)) {
      out += c;
      continue;
    }
    const auto& alphabet = c >= 'a' ? kSmall : kLarge;
    const std::string_view letter = alphabet[static_cast<std::size_t>(lower(c) - 'a')];
    out += letter;
    if (more > 0 && std::string_view("aeioun").find(lower(c)) != std::string_view::npos) {
      out += kSmall[static_cast<std::size_t>(lower(c) - 'a')];
      --more;
    }
  }
  for (; more > 0; --more) out += "·";
  return out;
}

}  // namespace

std::vector<PoFile::Message> pseudoMessages(const PoFile& messages) {
  std::vector<PoFile::Message> all;
  for (const PoFile::Message& message : messages.messages)
    all.push_back({message.id, marked(message.id)});
  return all;
}

}  // namespace palpa::language
