#pragma once

#include <filesystem>
#include <functional>
#include <nlohmann/json.hpp>
#include <ostream>
#include <string>
#include <vector>

/// Which reader a schema has to agree with, on which documents, and where the two cannot.
namespace palpa::schemas {

struct Sample {
  std::string asset;    ///< a shipped file, under assets/; of nothing shipped: where it would lie
  nlohmann::json more;  ///< merged into it (RFC 7396), so that all of a reader is reached
};

/// Patterns of damages ("/end/time_limit_s at 3601").
using Exceptions = std::vector<std::string>;

struct Kind {
  std::string name;  ///< of its schema
  std::vector<Sample> samples;
  std::function<void(const std::filesystem::path&)> read;  ///< throws for what is refused
  /// The reader refuses what no schema can: fields that contradict each other, files and names that
  /// are not there.
  Exceptions stricter;
  /// The reader takes what it was not meant to; the schema says what is meant.
  Exceptions forgiving;
  Exceptions elsewhere;  ///< read by none of the readers asked here
  Exceptions free = {};  ///< places of keys that a file may name as it likes
  std::function<void(nlohmann::json*)> seal = {};  ///< renews a checksum after a change
};

inline void PrintTo(const Kind& kind, std::ostream* out) { *out << kind.name; }

std::vector<Kind> everyKind();

}  // namespace palpa::schemas
