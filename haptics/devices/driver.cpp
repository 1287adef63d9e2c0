#include "haptics/devices/driver.h"

#include <algorithm>
#include <charconv>

namespace palpa::haptics {
namespace {

std::string written(double number) {
  char text[32];
  const std::to_chars_result end = std::to_chars(text, text + sizeof text, number);
  return {text, end.ptr};
}

}  // namespace

std::string DriverSettings::text(std::string_view field) const {
  const auto found = texts_.find(field);
  return found == texts_.end() ? "" : found->second;
}

double DriverSettings::number(std::string_view field, double otherwise) const {
  const auto found = numbers_.find(field);
  return found == numbers_.end() ? otherwise : found->second;
}

std::vector<std::string> DriverSettings::words() const {
  std::vector<std::string> all;
  for (const auto& [field, text] : texts_) all.push_back(field + "=" + text);
  for (const auto& [field, number] : numbers_) all.push_back(field + "=" + written(number));
  return all;
}

DriverSettings DriverSettings::ofWords(const std::vector<std::string>& words,
                                       const std::vector<DriverField>& fields) {
  DriverSettings settings;
  for (const std::string& word : words) {
    const std::size_t equals = std::min(word.find('='), word.size());
    const std::string name = word.substr(0, equals);
    const std::string value = equals < word.size() ? word.substr(equals + 1) : "";
    const auto field = std::find_if(fields.begin(), fields.end(),
                                    [&](const DriverField& one) { return one.name == name; });
    if (field == fields.end()) continue;
    double number = 0;
    if (field->kind == DriverField::Kind::text || field->kind == DriverField::Kind::file)
      settings.set(name, value);
    else if (std::from_chars(value.data(), value.data() + value.size(), number).ec == std::errc())
      settings.set(name, number);
  }
  return settings;
}

const std::vector<const DriverDescription*>& drivers() {
  static const std::vector<const DriverDescription*> all = listedDrivers();
  return all;
}

const DriverDescription* driverNamed(std::string_view name) {
  for (const DriverDescription* one : drivers())
    if (one->name == name) return one;
  return nullptr;
}

}  // namespace palpa::haptics
