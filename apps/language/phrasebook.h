#pragma once

#include <functional>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "apps/language/po_file.h"
#include "apps/language/reading.h"

namespace palpa::language {

/// Says English texts of the program in another language. Messages are as in the sources, with
/// {1}, {2} ... for what was put in: "{1} mm of {2}". A text may be one message, or several put
/// together ("a: b. c"), or hold names that are none; of all ways to read it the one is taken that
/// leaves the fewest letters without a message, of these the one with the fewest messages. What is
/// put in is said by the same rule. What is no message stays as it is, but for its numbers; so does
/// what is typed: options, and commands of palpa. Columns of a line, two blanks or more apart,
/// begin where they did as far as what stands before them leaves room.
class Phrasebook {
 public:
  /// English: every text stays as it is.
  Phrasebook();
  /// Messages without a translation are passed over. Throws UsageError for a translation with a
  /// place that its message does not have.
  Phrasebook(const std::vector<PoFile::Message>& messages, NumberForm numbers);
  ~Phrasebook();
  Phrasebook(Phrasebook&&) noexcept;
  Phrasebook& operator=(Phrasebook&&) noexcept;

  bool isEnglish() const { return !pages_; }
  std::string said(std::string_view english) const;

 private:
  struct Pages;
  std::unique_ptr<const Pages> pages_;
};

}  // namespace palpa::language
