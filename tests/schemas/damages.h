#pragma once

#include <functional>
#include <map>
#include <nlohmann/json.hpp>
#include <set>
#include <string>

/// Ways in which a document can be wrong, one field at a time.
namespace palpa::schemas {

/// Every figure that a schema holds the field of this name against, wherever it stands.
using Limits = std::map<std::string, std::set<double>>;
Limits limitsIn(const nlohmann::json& schema);

/// A document without the ranges that its figures carry themselves ({"value", "range"}): these
/// would hide those of the reader.
nlohmann::json withoutOwnRanges(nlohmann::json document);

/// What was done to which field: "/end/time_limit_s at 3601".
using Judge = std::function<void(const std::string& damage, const nlohmann::json& document)>;

/// Each field in turn taken away, of every other type, at and beyond its limits; each object with
/// an unknown field; each list of plain values longer and shorter. Of a long list its first two
/// entries and its last stand for all.
void eachDamage(const nlohmann::json& document, const Limits& limits, const Judge& judge);

/// A key as it may be mistyped.
struct Mistyped {
  std::string place;  ///< of the key: "/end/time_limit_s"
  std::string right, wrong;
};

/// Each key in turn with two letters swapped, with one left out, and with one doubled.
void eachMisspelling(
    const nlohmann::json& document,
    const std::function<void(const Mistyped& key, const nlohmann::json& document)>& judge);

}  // namespace palpa::schemas
