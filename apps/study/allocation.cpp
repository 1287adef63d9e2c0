#include "apps/study/allocation.h"

#include <utility>

#include "apps/runtime/random.h"

namespace palpa::study {

std::string conditionOf(const Allocation& allocation, const std::string& group, std::uint64_t seed,
                        std::int64_t place) {
  const auto size = static_cast<std::size_t>(allocation.block);
  const std::size_t index = static_cast<std::size_t>(place - 1);
  std::vector<std::size_t> order(size);
  for (std::size_t i = 0; i < size; ++i) order[i] = i % allocation.conditions.size();
  runtime::RandomStream random(seed,
                               "study.allocation." + group + "." + std::to_string(index / size));
  for (std::size_t i = size; i > 1; --i)
    std::swap(order[i - 1], order[static_cast<std::size_t>(
                                random.uniform() * static_cast<double>(i))]);  // Fisher and Yates
  return allocation.conditions[order[index % size]];
}

}  // namespace palpa::study
