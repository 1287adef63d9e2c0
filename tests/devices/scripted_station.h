#pragma once

#include "falcon_rig.h"
#include "scripted_usb.h"

namespace palpa::test {

/// Driver on a scripted cable.
struct Station {
  explicit Station(Bytes firmware = someImage())
      : twin(someImage()),
        owned(std::make_unique<ScriptedUsb>(twin)),
        usb(*owned),
        rig(std::move(owned), twin, std::move(firmware)) {}
  FalconTwin twin;
  std::unique_ptr<ScriptedUsb> owned;
  ScriptedUsb& usb;
  FalconRig rig;
};

/// The same with the device ready and a force on the way.
struct ReadyStation : Station {
  ReadyStation() {
    twin.startFirmware();
    EXPECT_TRUE(rig.reach(haptics::DriverState::ready));
    rig.f_D = {0, 0, 2};
    rig.step();
    rig.step();
    EXPECT_TRUE(rig.lastCommand().pushes());
  }
};

}  // namespace palpa::test
