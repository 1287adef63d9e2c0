#pragma once

#include <functional>
#include <string>

#include "apps/runtime/executive.h"

namespace palpa::runtime {

/// An activity from a function.
class Doing final : public Activity {
 public:
  using Step = std::function<std::int64_t(std::int64_t)>;
  Doing(std::string name, Step step) : name_(std::move(name)), step_(std::move(step)) {}
  const char* name() const override { return name_.c_str(); }
  std::int64_t step(std::int64_t now_ns) override { return step_(now_ns); }

 private:
  std::string name_;
  Step step_;
};

}  // namespace palpa::runtime
