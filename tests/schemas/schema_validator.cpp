#include "schema_validator.h"

#include <valijson/adapters/nlohmann_json_adapter.hpp>
#include <valijson/schema.hpp>
#include <valijson/schema_parser.hpp>
#include <valijson/validation_results.hpp>
#include <valijson/validator.hpp>

namespace palpa::schemas {

using Adapter = valijson::adapters::NlohmannJsonAdapter;

struct SchemaValidator::Impl {
  valijson::Schema schema;
  valijson::Validator validator{valijson::Validator::kStrongTypes};
};

SchemaValidator::SchemaValidator(const nlohmann::json& schema) : impl_(std::make_unique<Impl>()) {
  valijson::SchemaParser parser(valijson::SchemaParser::kDraft7);
  parser.populateSchema(Adapter(schema), impl_->schema);
}

SchemaValidator::~SchemaValidator() = default;

bool SchemaValidator::accepts(const nlohmann::json& document) const {
  return impl_->validator.validate(impl_->schema, Adapter(document), nullptr);
}

std::string SchemaValidator::faults(const nlohmann::json& document) const {
  valijson::ValidationResults results;
  impl_->validator.validate(impl_->schema, Adapter(document), &results);
  std::string all;
  valijson::ValidationResults::Error error;
  while (results.popError(error)) {
    for (const std::string& step : error.context) all += step;
    all += ": ";
    all += error.description;
    all += '\n';
  }
  return all;
}

}  // namespace palpa::schemas
