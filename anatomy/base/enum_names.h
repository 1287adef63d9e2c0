#pragma once

#include <algorithm>
#include <cstddef>
#include <initializer_list>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "anatomy/base/json_file.h"

namespace palpa {

/// What each enumerator of `Enum` (0, 1, ...) is called in files, tables and on pages: the one
/// place where its texts stand. Names are given in the enumerators' order.
template <class Enum>
class EnumNames {
 public:
  EnumNames(std::initializer_list<std::string> names) : names_(names) {}

  const std::string& of(Enum e) const { return names_.at(static_cast<std::size_t>(e)); }

  /// None for an unknown name.
  std::optional<Enum> named(std::string_view name) const {
    const auto at = std::find(names_.begin(), names_.end(), name);
    if (at == names_.end()) return std::nullopt;
    return static_cast<Enum>(at - names_.begin());
  }

  /// Of a file's field; `known` ends the sentence that refuses any other (UsageError): "known:
  /// virtual, net_ft".
  Enum in(const JsonFile& file, const std::string& at, const std::string& known) const {
    const std::string name = file.text(at);
    const std::optional<Enum> e = named(name);
    if (!e) file.refuse(at, "is \"" + name + "\"; " + known);
    return *e;
  }
  Enum in(const JsonFile& file, const std::string& at) const {
    return in(file, at, "known: " + list());
  }

  std::size_t size() const { return names_.size(); }

  /// "virtual, mouse, replay".
  std::string list() const {
    std::string all;
    for (const std::string& name : names_) all.append(all.empty() ? "" : ", ").append(name);
    return all;
  }

 private:
  std::vector<std::string> names_;
};

}  // namespace palpa
