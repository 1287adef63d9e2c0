#include "tests/openxr_runtime/plan.h"

#include <cstdlib>
#include <sstream>

namespace palpa::test_xr {
namespace {

template <class Use>
void forEach(const std::string& text, char between, Use use) {
  std::istringstream words(text);
  for (std::string word; std::getline(words, word, between);) use(word);
}

}  // namespace

Plan planFromEnvironment() {
  Plan plan;
  const char* text = std::getenv("PALPA_TEST_XR");
  forEach(text ? text : "", ';', [&](const std::string& word) {
    const std::size_t at = word.find('=');
    const std::string name = word.substr(0, at),
                      value = at == std::string::npos ? "" : word.substr(at + 1);
    if (name == "eyes") {
      plan.eyes.clear();
      forEach(value, ',', [&](const std::string& size) {
        plan.eyes.emplace_back(std::atoi(size.c_str()),
                               std::atoi(size.substr(size.find('x') + 1).c_str()));
      });
    } else if (name == "formats") {
      plan.formats.clear();
      forEach(value, ',', [&](const std::string& format) {
        plan.formats.push_back(std::strtoll(format.c_str(), nullptr, 16));
      });
    } else if (name == "images")
      plan.images = std::atoi(value.c_str());
    else if (name == "blend")
      plan.blend = value;
    else if (name == "apart")
      plan.apart = std::atof(value.c_str());
    else if (name == "rate")
      plan.rate_Hz = std::atof(value.c_str());
    else if (name == "position")
      plan.position = value != "0";
    else if (name == "turned")
      plan.turned_deg = std::atof(value.c_str());
    else if (name == "drift")
      plan.drift_mm = std::atof(value.c_str());
    else if (name == "stands")
      plan.stands = std::atoi(value.c_str());
    else if (name == "controller")
      plan.controller = value;
    else if (name == "hang")
      plan.hang = value;
    else if (name == "service")
      plan.service = value;
    else if (name == "fault") {
      plan.fault = value.substr(0, value.find('@'));
      plan.fault_frame = value.find('@') == std::string::npos
                             ? 0
                             : std::atoi(value.substr(value.find('@') + 1).c_str());
    } else if (name == "report")
      plan.report = value;
    else if (name == "pictures")
      plan.pictures = value;
    else if (name == "layers")
      plan.layers = value;
  });
  return plan;
}

}  // namespace palpa::test_xr
