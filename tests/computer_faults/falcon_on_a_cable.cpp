#include "falcon_on_a_cable.h"

#include <fcntl.h>
#include <sys/mman.h>
#include <unistd.h>

#include <cstdlib>

#include "tests/devices/falcon_twin.h"

namespace palpa::test {
namespace {

FalconWorld* mapped(const char* file) {
  const int fd = ::open(file, O_RDWR | O_CLOEXEC);
  void* bytes =
      fd < 0 ? MAP_FAILED
             : ::mmap(nullptr, sizeof(FalconWorld), PROT_READ | PROT_WRITE, MAP_SHARED, fd, 0);
  if (bytes == MAP_FAILED) std::abort();
  ::close(fd);
  return static_cast<FalconWorld*>(bytes);
}

struct Cable {
  Cable() : twin({}), world(mapped(std::getenv("PALPA_FALCON"))) { twin.startFirmware(); }
  FalconTwin twin;
  FalconWorld* const world;
};

Cable& cable() {
  static Cable one;
  return one;
}

}  // namespace

bool hasFalcon() noexcept {
  static const bool there = std::getenv("PALPA_FALCON");
  return there;
}

void falconControl(int request, int value) {
  const std::scoped_lock lock(cable().twin.mutex);
  cable().twin.control(request, value);
}

void falconOut(std::span<const std::uint8_t> bytes) {
  auto& [twin, world] = cable();
  const std::scoped_lock lock(twin.mutex);
  std::copy_n(world->encoder, 3, twin.reply.encoder.begin());
  twin.out(bytes);
  if (twin.commands.empty()) return;
  std::ranges::copy(twin.commands.back().motor, world->motor);
  world->packets += static_cast<std::uint32_t>(twin.commands.size());
  twin.commands.clear();
}

int falconIn(std::span<std::uint8_t> into) {
  const std::scoped_lock lock(cable().twin.mutex);
  const Bytes packet = cable().twin.in();
  const std::size_t size = std::min(packet.size(), into.size());
  std::copy_n(packet.begin(), size, into.begin());
  return static_cast<int>(size);
}

}  // namespace palpa::test
