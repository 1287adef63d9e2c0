#pragma once

#include <map>
#include <string>
#include <string_view>

#include "apps/language/languages.h"

namespace palpa::language {

/// A page of ours (HTML, or SVG in it) in another language: its texts, and its attributes title,
/// alt, aria-label and placeholder; `lang` of its <html>, and `dir` where the language goes from
/// right to left. What stands in an element with translate="no" (what somebody typed), in <style>
/// and in <script> stays. The page is one that this program wrote: its elements are closed.
class PageSpeaker {
 public:
  explicit PageSpeaker(const Spoken& spoken) : spoken_(spoken) {}
  /// What comes next of a page, which may be cut between any two elements.
  std::string more(std::string_view page);

 private:
  std::string said(std::string_view written);
  std::string tag(std::string_view written);
  std::string withAttributes(std::string_view written);
  void count(std::string_view name, std::string_view written);

  const Spoken& spoken_;
  int kept_ = 0;  ///< how deep within an element that stays as it is
  std::map<std::string, std::string, std::less<>> said_;  ///< pages say the same again and again
};

std::string pageIn(std::string_view page, const Spoken& spoken);

}  // namespace palpa::language
