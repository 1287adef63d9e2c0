#pragma once

#include <pqxx/pqxx>

#include <cmath>
#include <cstdio>
#include <stdexcept>
#include <string>
#include <vector>

#include "apps/record/store/sql_connection.h"

/// What libpqxx 7 calls otherwise than libpqxx 6; values to its texts and back.
namespace palpa::record::postgres {

#if PQXX_VERSION_MAJOR >= 7

/// Of a connection that was made: it does not connect anew by itself.
inline void stayLost(pqxx::connection&) {}

/// Misuse, or a value that cannot be converted: what is no pqxx::failure.
using LogicFailure = std::logic_error;
inline std::string reasonOf(const LogicFailure& failure) { return failure.what(); }

/// `parameters`: null pointers are NULL.
inline pqxx::result executeTexts(pqxx::transaction_base& transaction, const std::string& sql,
                                 const std::vector<const char*>& parameters) {
  pqxx::params values;
  values.append_multi(parameters);
  return transaction.exec(sql, values);
}

#else

/// Of a connection that was made: it does not connect anew by itself, in a rollback either, where
/// no watch would see it. (Deprecated since libpqxx 7 never does.)
inline void stayLost(pqxx::connection& connection) {
#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wdeprecated-declarations"
  connection.inhibit_reactivation(true);
#pragma GCC diagnostic pop
}

/// Misuse, or a value that cannot be converted: what is no pqxx::failure.
using LogicFailure = pqxx::pqxx_exception;
inline std::string reasonOf(const LogicFailure& failure) { return failure.base().what(); }

/// `parameters`: null pointers are NULL.
inline pqxx::result executeTexts(pqxx::transaction_base& transaction, const std::string& sql,
                                 const std::vector<const char*>& parameters) {
  return transaction.exec_params(sql, pqxx::prepare::make_dynamic_params(parameters));
}

#endif

inline std::string exactly(double value) {
  char text[40];
  std::snprintf(text, sizeof text, "%.17g", value);
  return text;
}

inline bool isNothing(const SqlValue& v) {
  const auto* real = std::get_if<double>(&v);
  return v.index() == 0 || (real && std::isnan(*real));
}

inline std::vector<std::string> textsOf(const std::vector<SqlValue>& values) {
  std::vector<std::string> texts;
  for (const SqlValue& v : values) {
    if (const auto* whole = std::get_if<std::int64_t>(&v))
      texts.push_back(std::to_string(*whole));
    else if (const auto* real = std::get_if<double>(&v))
      texts.push_back(exactly(*real));
    else if (const auto* text = std::get_if<std::string>(&v))
      texts.push_back(*text);
    else
      texts.emplace_back();
  }
  return texts;
}

inline std::vector<SqlValue> valuesOf(const pqxx::row& row) {
  constexpr pqxx::oid kInt8 = 20, kInt2 = 21, kInt4 = 23, kFloat8 = 701;
  std::vector<SqlValue> values;
  for (const pqxx::field& field : row) {
    const pqxx::oid type = field.type();
    if (field.is_null())
      values.emplace_back(std::monostate{});
    else if (type == kInt8 || type == kInt4 || type == kInt2)
      values.emplace_back(field.as<std::int64_t>());
    else if (type == kFloat8)
      values.emplace_back(field.as<double>());
    else
      values.emplace_back(std::string(field.c_str(), field.size()));
  }
  return values;
}

inline pqxx::result execute(pqxx::transaction_base& transaction, const std::string& sql,
                            const std::vector<SqlValue>& values) {
  const std::vector<std::string> texts = textsOf(values);
  std::vector<const char*> parameters;
  for (std::size_t i = 0; i < values.size(); ++i)
    parameters.push_back(isNothing(values[i]) ? nullptr : texts[i].c_str());
  return executeTexts(transaction, sql, parameters);
}

}  // namespace palpa::record::postgres
