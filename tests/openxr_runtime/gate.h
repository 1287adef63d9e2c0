#pragma once

#include <string>

#include <openxr/openxr.h>

namespace palpa::test_xr {

/// What every call does first: it does not return while the plan's file names it ("xrPollEvent"),
/// and asks the plan's process, which can be stopped. Once it hangs, a file of the same name with
/// ".reached" says so.
void pass(const std::string& function);
void dismissService();

template <auto function>
struct Gated;
/// A function of the runtime's as programs see it.
template <class... In, XrResult (*function)(In...)>
struct Gated<function> {
  inline static const char* name = "";
  static XrResult call(In... in) {
    pass(name);
    return function(in...);
  }
};

}  // namespace palpa::test_xr
