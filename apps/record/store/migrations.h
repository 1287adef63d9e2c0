#pragma once

#include "apps/record/store/sql_connection.h"

namespace palpa::record {

/// Version of the tables that this program writes.
int newestSchema();

/// 0 for an empty store. Throws Error for a store that is newer than this program.
int schemaOf(SqlConnection& connection);

/// Brings the tables up to `version` (default: the newest), step by step in one transaction;
/// several stations may start at once. Returns the version found.
int migrate(SqlConnection& connection, int version = newestSchema());

/// Every table but the version's, parents first; and its columns by name, since two stores may hold
/// them in different order.
const std::vector<std::string>& tableNames();
const std::string& columnsOf(const std::string& table);

}  // namespace palpa::record
