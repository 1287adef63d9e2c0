#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "apps/study/protocol.h"

namespace palpa::study {

/// The condition of a group's place 1, 2, ...: every `block` places hold each condition equally
/// often, in an order drawn anew for each block from (seed, group, block) alone. So the groups are
/// balanced at the end of every block, and who knows all places given so far cannot tell the next
/// one unless a block is nearly full.
std::string conditionOf(const Allocation& allocation, const std::string& group, std::uint64_t seed,
                        std::int64_t place);

}  // namespace palpa::study
