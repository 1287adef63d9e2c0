#pragma once

#include <map>
#include <string>
#include <string_view>
#include <vector>

namespace palpa::language {

/// A file of gettext: https://www.gnu.org/software/gettext/manual (PO files). Of what it may hold
/// we use messages and the header; plural forms are refused. What has a context is not said by the
/// program: the guide's paragraphs.
struct PoFile {
  struct Message {
    std::string id, translation;  ///< UTF-8; the translation is empty where there is none yet
  };
  std::map<std::string, std::string> header;  ///< "Language", "Content-Type" ...
  std::vector<Message> messages;
  std::vector<Message> of_the_guide = {};
};

/// `name` is for words about what is wrong. Throws UsageError.
PoFile readPo(std::string_view text, const std::string& name);

inline constexpr char kPseudo[] = "qps", kPseudoFromRight[] = "qps-rtl";

/// Each message in a language that nobody speaks: every letter with a mark, a third longer. What
/// people see without marks has no message; what is cut has no room for other languages.
std::vector<PoFile::Message> pseudoMessages(const PoFile& messages);

}  // namespace palpa::language
