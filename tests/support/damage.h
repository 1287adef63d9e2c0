#pragma once

#include <gtest/gtest.h>
#include <sys/resource.h>

#include <cstdint>
#include <random>
#include <string>

namespace palpa::test {

/// Seeded, the same on every machine: the distributions of the standard library are not.
class DamageDice {
 public:
  explicit DamageDice(std::uint64_t seed) : bits_(seed) {}
  std::size_t below(std::size_t n) { return n ? static_cast<std::size_t>(bits_() % n) : 0; }

 private:
  std::mt19937_64 bits_;
};

/// What a reader says of a damaged file: one line that begins with where.
inline void expectClearWord(const std::exception& error, const std::string& where) {
  const std::string words = error.what();
  ASSERT_EQ(words.find('\n'), std::string::npos) << words;
  ASSERT_EQ(words.rfind(where + ": ", 0), 0u) << words;
}

/// Of the whole process so far, sanitizer and all: what damaged files may cost at most.
inline void expectLessThan2GiB() {
  rusage used{};
  ASSERT_EQ(getrusage(RUSAGE_SELF, &used), 0);
  EXPECT_LT(used.ru_maxrss, 2L << 20) << "KiB";
}

}  // namespace palpa::test
