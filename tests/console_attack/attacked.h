#pragma once

#include <gtest/gtest.h>

#include "bench.h"

namespace palpa::console_attack {

inline constexpr char kMarkup[] = "<script>alert(1)</script><img src=x onerror=alert(2)>\"'&";

/// One console and one session for all tests of this program; a test that ends one of them begins
/// it anew.
class Attacked : public ::testing::Test {
 protected:
  friend class Ending;
  void SetUp() override;
  /// The session that runs; begun where none does: a simulated expert in real time, many trials,
  /// for a trainee with markup in every field.
  static const std::string& session();
  /// It tells more than before: new entries, and a later second of the session.
  static ::testing::AssertionResult goesOn();
  /// Since the test began, refused.log has a line with this.
  static ::testing::AssertionResult isNoted(const std::string& words);
  /// `Console::events` reads until there are so many.
  static auto until(std::size_t count) {
    return [count](const std::vector<Event>& all) { return all.size() >= count; };
  }
  static void expectNumbered(const std::vector<Event>& all, std::size_t first) {
    for (std::size_t i = 0; i < all.size(); ++i) ASSERT_EQ(all[i].id, first + i);
  }
  static Console& console() { return *console_; }
  static const fs::path& folder() { return folder_->path(); }

 private:
  static void beginAll();
  static void endAll();
  static std::unique_ptr<ShortFolder> folder_;
  static std::unique_ptr<Console> console_;
  static std::string session_;
  static std::size_t noted_;
};

}  // namespace palpa::console_attack
