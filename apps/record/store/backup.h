#pragma once

#include "apps/record/store/sql_connection.h"

namespace palpa::record {

/// Copies every row of one store into another, which must be empty: from one moment, in one
/// transaction, table by table. Between a file and a server, too: a backup of a server is a file, a
/// restored file may be a server, and a centre that grows moves so. Both are brought to the newest
/// tables first. Returns the rows copied. Throws Error for a target that holds trainees; nothing of
/// it stays when it fails.
std::size_t copyStore(SqlConnection& from, SqlConnection& to);

}  // namespace palpa::record
