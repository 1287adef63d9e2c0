#pragma once

#include <pqxx/pqxx>

#include <stdexcept>
#include <string>
#include <vector>

/// What libpqxx 7 calls otherwise than libpqxx 6.
namespace palpa::record::postgres {

#if PQXX_VERSION_MAJOR >= 7

/// Of a connection that was made: it does not connect anew by itself.
inline void stayLost(pqxx::connection&) {}

/// Misuse, or a value that cannot be converted: what is no pqxx::failure.
using LogicFailure = std::logic_error;
inline std::string reasonOf(const LogicFailure& failure) { return failure.what(); }

/// `parameters`: null pointers are NULL.
inline pqxx::result execute(pqxx::transaction_base& transaction, const std::string& sql,
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
inline pqxx::result execute(pqxx::transaction_base& transaction, const std::string& sql,
                            const std::vector<const char*>& parameters) {
  return transaction.exec_params(sql, pqxx::prepare::make_dynamic_params(parameters));
}

#endif

}  // namespace palpa::record::postgres
