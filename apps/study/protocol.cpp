#include "apps/study/protocol.h"

#include "anatomy/geometry/error.h"

namespace palpa::study {
namespace {

template <class Named>
const Named* named(const std::vector<Named>& all, const std::string& name) {
  for (const Named& one : all)
    if (one.name == name) return &one;
  return nullptr;
}

}  // namespace

const Group* Protocol::group(const std::string& name) const { return named(groups, name); }
const Condition* Protocol::condition(const std::string& name) const {
  return named(conditions, name);
}

const Block& Protocol::block(std::int64_t step) const {
  for (const Session& session : sessions)
    for (const Block& block : session.blocks)
      if (block.step == step) return block;
  throw Error("has no step " + std::to_string(step), file.string(),
              "Was the protocol changed while the study runs?");
}

int Protocol::sessionOf(std::int64_t step) const {
  int number = 0;
  for (const Session& session : sessions) {
    ++number;
    if (!session.blocks.empty() && step <= session.blocks.back().step) return number;
  }
  return number;
}

}  // namespace palpa::study
