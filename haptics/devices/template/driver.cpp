#include "haptics/devices/driver.h"

#include "haptics/devices/template/template_driver.h"

namespace palpa::haptics::templates {

const DriverDescription& description();

namespace {

constexpr char kPort[] = "port", kUsualPort[] = "/dev/ttyUSB0";

std::unique_ptr<Driver> make(const DriverSettings& settings) {
  const std::string port = settings.text(kPort);
  return std::make_unique<TemplateDriver>(port.empty() ? kUsualPort : port);
}

}  // namespace

const DriverDescription& description() {
  static const DriverDescription it{
      .name = "template",
      .title = "Template",
      .fields = {{.name = kPort,
                  .kind = DriverField::Kind::text,
                  .title = "Port",
                  .about = "Serial port (default /dev/ttyUSB0)"}},
      .usb = {},
      .udev_rule = "",
      .capabilities = [](const DriverSettings&) { return templateCapabilities(); },
      .make = make};
  return it;
}

}  // namespace palpa::haptics::templates
