#include "anatomy/base/file_schema.h"

#include <algorithm>
#include <iterator>
#include <map>
#include <mutex>
#include <regex>
#include <stdexcept>
#include <utility>
#include <vector>

#include "anatomy/base/error.h"
#include "anatomy/base/json_fields.h"
#include "anatomy/base/json_text.h"
#include "anatomy/base/nearest_word.h"
#include "anatomy/base/text_forms.h"

namespace palpa {
namespace {

using nlohmann::json;

constexpr std::size_t kMostNamesTold = 12;
constexpr std::size_t kLongestName = 256;  // of a field; std::regex goes as deep as a text is long
constexpr const char* kSchemaEnding = ".schema.json";

/// A schema that is there, parsed once.
const json& parsedSchema(std::string_view kind) {
  static std::map<std::string, json, std::less<>> parsed;
  static std::mutex mutex;
  const std::lock_guard<std::mutex> lock(mutex);
  if (const auto found = parsed.find(kind); found != parsed.end()) return found->second;
  for (const SchemaText& schema : schemaTexts())
    if (schema.kind == kind)
      return parsed.emplace(std::string(kind), parseJson(schema.text)).first->second;
  throw std::logic_error("no schema of " + std::string(kind));
}

/// A part of a schema, and the whole in which its references are looked up.
struct Part {
  const json* schema;
  const json* whole;
};
using Parts = std::vector<Part>;

Part partReferredTo(const std::string& reference, const json& whole) {
  const std::size_t hash = std::min(reference.find('#'), reference.size());
  const std::string file = reference.substr(0, hash);
  const json& other =
      file.empty()
          ? whole
          : parsedSchema(file.substr(0, file.size() - std::string_view(kSchemaEnding).size()));
  const std::string place = hash == reference.size() ? "" : reference.substr(hash + 1);
  return {&other.at(json::json_pointer(place)), &other};
}

/// Adds a part and all parts that speak of the same place of a file.
void gather(const Part& part, Parts* parts) {
  const json& schema = *part.schema;
  if (!schema.is_object()) return;
  if (schema.contains("$ref"))
    return gather(partReferredTo(schema.at("$ref").get<std::string>(), *part.whole), parts);
  parts->push_back(part);
  for (const char* list : {"allOf", "anyOf", "oneOf"})
    if (schema.contains(list))
      for (const json& one : schema.at(list)) gather({&one, part.whole}, parts);
  for (const char* branch : {"then", "else"})
    if (schema.contains(branch)) gather({&schema.at(branch), part.whole}, parts);
}

/// A part of a schema, by its name; null where there is none.
const json* memberOf(const json& schema, const std::string& name) {
  const auto found = schema.find(name);
  return found == schema.end() ? nullptr : &*found;
}

/// What the parts at an object know of its fields.
class KnownFields {
 public:
  explicit KnownFields(const Parts& parts) : parts_(parts) {
    for (const Part& part : parts_) {
      const json& schema = *part.schema;
      const json* const more = memberOf(schema, "additionalProperties");
      const json* const names = memberOf(schema, "propertyNames");
      closed_ = closed_ || (more && *more == false) || (names && names->contains("enum"));
      const json* const properties = memberOf(schema, "properties");
      if (!properties) continue;
      for (const auto& [name, ignored] : properties->items())
        if (std::find(names_.begin(), names_.end(), name) == names_.end()) names_.push_back(name);
    }
  }

  bool closed() const { return closed_; }
  const std::vector<std::string>& names() const { return names_; }

  bool knows(const std::string& field) const {
    if (std::find(names_.begin(), names_.end(), field) != names_.end()) return true;
    if (field.size() > kLongestName) return false;
    preparePatterns();
    return std::any_of(parts_.begin(), parts_.end(), [&](const Part& part) {
      const json* const patterns = memberOf(*part.schema, "patternProperties");
      if (!patterns) return false;
      const auto& all = patterns->items();
      return std::any_of(all.begin(), all.end(), [&](const auto& pattern) {
        return std::regex_search(field, std::regex(pattern.key()));
      });
    });
  }

  /// What the schema says of one field.
  Parts of(const std::string& field) const {
    Parts found;
    for (const Part& part : parts_) {
      const json& schema = *part.schema;
      const json* const properties = memberOf(schema, "properties");
      const json* const named = properties ? memberOf(*properties, field) : nullptr;
      const json* const said = named ? named : memberOf(schema, "additionalProperties");
      if (said) gather({said, part.whole}, &found);
    }
    return found;
  }

 private:
  const Parts& parts_;
  bool closed_ = false;
  std::vector<std::string> names_;
};

Parts itemsOf(const Parts& parts) {
  Parts found;
  for (const Part& part : parts)
    if (part.schema->contains("items")) gather({&part.schema->at("items"), part.whole}, &found);
  return found;
}

std::string listed(const std::vector<std::string>& names) {
  std::string all;
  for (std::size_t i = 0; i < std::min(names.size(), kMostNamesTold); ++i)
    all += (i ? ", " : "") + names[i];
  return names.size() > kMostNamesTold ? all + ", ..." : all;
}

/// Where in a file: its name with the entries of lists, and the fields from there.
struct Place {
  std::string name, path;

  Place field(const std::string& key) const {
    return {name, path.empty() ? printable(key) : path + "/" + printable(key)};
  }
  Place entry(std::size_t number) const {
    return {name + (path.empty() ? "" : ", \"" + path + "\"") + ", entry " + std::to_string(number),
            ""};
  }
};

/// What may have been meant in an object by a field that is unknown: best what it has not yet.
std::string proposalFor(const std::string& key, const json& object, const KnownFields& known) {
  std::vector<std::string> names = known.names(), missing;
  for (const char* remark : {"about", "source"})
    if (known.knows(remark)) names.emplace_back(remark);
  std::copy_if(names.begin(), names.end(), std::back_inserter(missing),
               [&](const std::string& name) { return !object.contains(name); });
  const std::string best = didYouMean(key, missing);
  return best.empty() ? didYouMean(key, names) : best;
}

[[noreturn]] void refuseField(const JsonFile& file, const Place& place, const std::string& key,
                              const std::string& proposal, const KnownFields& known) {
  JsonFile(json(), place.name, file.remedy())
      .refuse(
          place.field(key).path,
          "is unknown" + (proposal.empty() ? "; known here: " + listed(known.names()) : proposal));
}

void walk(const JsonFile& file, const json& value, const Parts& parts, const Place& place) {
  if (parts.empty() || !value.is_structured()) return;
  if (value.is_array()) {
    const Parts items = itemsOf(parts);
    for (std::size_t i = 0; i < value.size() && !items.empty(); ++i)
      if (value[i].is_structured()) walk(file, value[i], items, place.entry(i + 1));
    return;
  }
  const KnownFields known(parts);
  for (const auto& [key, inner] : value.items()) {
    if (known.closed() && !known.knows(key))
      refuseField(file, place, key, proposalFor(key, value, known), known);
    if (inner.is_structured()) walk(file, inner, known.of(key), place.field(key));
  }
}

}  // namespace

void refuseUnknownFields(const JsonFile& file, std::string_view kind) {
  const json& schema = parsedSchema(kind);
  Parts parts;
  gather({&schema, &schema}, &parts);
  walk(file, file.json(), parts, {file.name(), ""});
}

std::vector<std::string> fieldsOf(std::string_view kind, const std::string& place) {
  const json& schema = parsedSchema(kind);
  Parts parts;
  gather({&schema, &schema}, &parts);
  for (std::size_t at = 0; at < place.size();) {
    const std::size_t end = std::min(place.find('/', at), place.size());
    const Parts inner = KnownFields(parts).of(place.substr(at, end - at));
    parts = inner;
    at = end + 1;
  }
  return KnownFields(parts).names();
}

int needKind(const JsonFile& file, std::string_view kind, int newest) {
  if (file.has("version")) file.needVersion(newest);
  refuseUnknownFields(file, kind);
  return file.needVersion(newest);
}

}  // namespace palpa
