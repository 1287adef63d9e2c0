#pragma once

#include <memory>
#include <nlohmann/json.hpp>
#include <string>

namespace palpa::schemas {

/// A JSON Schema of draft 07, without references, ready to judge documents. valijson's templates
/// are instantiated in the one source behind this.
class SchemaValidator {
 public:
  explicit SchemaValidator(const nlohmann::json& schema);  ///< throws where it is no schema
  ~SchemaValidator();
  SchemaValidator(const SchemaValidator&) = delete;
  SchemaValidator& operator=(const SchemaValidator&) = delete;

  bool accepts(const nlohmann::json& document) const;
  /// Every place that is wrong, with the reason; empty: none is.
  std::string faults(const nlohmann::json& document) const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace palpa::schemas
