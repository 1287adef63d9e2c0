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

/// Copies every row of one store into another, which must be empty: from one moment, in one
/// transaction, table by table. Between a file and a server, too: a backup of a server is a file, a
/// restored file may be a server, and a centre that grows moves so. Both are brought to the newest
/// tables first. Returns the rows copied. Throws Error for a target that holds trainees; nothing of
/// it stays when it fails.
std::size_t copyStore(SqlConnection& from, SqlConnection& to);

}  // namespace palpa::record
