#pragma once

#include "apps/link/data_tables.h"

namespace palpa::link {

/// Every table of the store, but those that are exported by name, that says whose each row is: a
/// person's export has everything, whatever the store learnt to keep.
std::vector<FurtherTable> furtherTables(record::RecordStore& store,
                                        const std::vector<record::Trainee>& who);

DataTable asTable(const FurtherTable& further);

}  // namespace palpa::link
