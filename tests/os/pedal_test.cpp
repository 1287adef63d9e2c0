#include "apps/os/pedal.h"

#include <fcntl.h>
#include <gtest/gtest.h>
#include <linux/input.h>
#include <sys/stat.h>
#include <unistd.h>

#include "anatomy/base/error.h"
#include "tests/support/scratch_folder.h"

namespace palpa::os {
namespace {

/// A pedal whose kernel is this test.
class PlayedPedal : public testing::Test {
 protected:
  PlayedPedal() {
    ::mkfifo(device_.c_str(), 0600);
    kernel_ = ::open(device_.c_str(), O_RDWR | O_NONBLOCK);
  }
  ~PlayedPedal() override { pullOut(); }
  void say(int type, int value) const {
    input_event event{};
    event.type = static_cast<__u16>(type);
    event.code = KEY_B;
    event.value = value;
    EXPECT_EQ(::write(kernel_, &event, sizeof event), static_cast<ssize_t>(sizeof event));
  }
  void pullOut() {
    if (kernel_ >= 0) ::close(kernel_);
    kernel_ = -1;
  }
  const palpa::test::ScratchFolder folder_{"pedal"};
  const std::string device_ = (folder_ / "pedal").string();
  int kernel_ = -1;
};

TEST_F(PlayedPedal, IsHeardWhenItGoesDownAndOnlyThen) {
  Pedal pedal(device_);
  EXPECT_FALSE(pedal.pressed());
  say(EV_KEY, 0);  // let go
  say(EV_KEY, 2);  // held
  say(EV_MSC, 1);
  say(EV_SYN, 0);
  EXPECT_FALSE(pedal.pressed());
  say(EV_KEY, 1);
  say(EV_SYN, 0);
  EXPECT_TRUE(pedal.pressed());
  EXPECT_FALSE(pedal.pressed());
  for (int i = 0; i < 40; ++i) say(EV_KEY, i == 0);
  EXPECT_TRUE(pedal.pressed());
  EXPECT_FALSE(pedal.pressed());
}

TEST_F(PlayedPedal, StopsOnceWhenItIsPulledOut) {
  Pedal pedal(device_);
  EXPECT_FALSE(pedal.pressed());
  EXPECT_GE(pedal.descriptor(), 0);
  pullOut();
  EXPECT_TRUE(pedal.pressed());
  EXPECT_LT(pedal.descriptor(), 0);
  EXPECT_FALSE(pedal.pressed());
}

TEST_F(PlayedPedal, OneThatIsNotThereIsNamed) {
  try {
    Pedal pedal((folder_ / "none").string());
    FAIL();
  } catch (const Error& e) {
    EXPECT_NE(std::string(e.what()).find("is not there"), std::string::npos) << e.what();
  }
}

}  // namespace
}  // namespace palpa::os
