#include <gtest/gtest.h>

#include <map>
#include <set>

#include "apps/assess/metrics/metric_table.h"
#include "schema_files.h"
#include "schema_validator.h"

/// The published schemas beside the files that are shipped.
namespace palpa::schemas {
namespace {

using nlohmann::json;

TEST(Shipped, EveryFileIsValid) {
  std::map<std::string, SchemaValidator> validators;
  for (const std::string& asset : shippedFiles()) {
    const std::vector<std::string> kinds = kindsOf(asset);
    EXPECT_FALSE(kinds.empty()) << asset << " is of no kind: give it a schema and a line in "
                                << "tests/schemas/schema_files.cpp";
    for (const std::string& kind : kinds)
      EXPECT_EQ(validators.try_emplace(kind, schemaOf(kind))
                    .first->second.faults(jsonOf(assetsFolder() / asset)),
                "")
          << asset << " as " << kind;
  }
  EXPECT_GT(validators.size(), 20u) << "the walk has lost the files";
}

/// Fields under "properties" whose words an editor shows, with the place of each.
void collectFields(const json& schema, const std::string& place, std::map<std::string, json>* out) {
  if (schema.contains("properties"))
    for (const auto& [name, field] : schema.at("properties").items()) {
      const std::string at = place + "/" + name;
      if (name != "value") out->emplace(at, field);  // limits alone, of a figure as an object
      collectFields(field, at, out);
    }
  if (schema.contains("items")) collectFields(schema.at("items"), place, out);
}

TEST(Schemas, EveryFieldIsExplained) {
  for (const std::string& kind : publishedKinds()) {
    const json schema = publishedSchema(kind);
    EXPECT_EQ(schema.value("$schema", ""), "http://json-schema.org/draft-07/schema#") << kind;
    std::map<std::string, json> fields{{"", schema}};
    collectFields(schema, "", &fields);
    for (const auto& [place, field] : fields)
      for (const char* words : {"title", "description"})
        EXPECT_TRUE(field.contains(words)) << kind << place << " has no " << words;
  }
}

TEST(Schemas, ChecklistsKnowEveryFigureOfATrial) {
  std::set<std::string> known, offered;
  for (const metrics::MetricDefinition& metric : metrics::metricTable()) known.insert(metric.name);
  const json schema = publishedSchema("checklist");
  for (const json& name :
       schema.at(json::json_pointer("/properties/critical/items/properties/metric/enum")))
    offered.insert(name.get<std::string>());
  EXPECT_EQ(offered, known);
}

}  // namespace
}  // namespace palpa::schemas
