#include "apps/bench/onlookers.h"

#include <unistd.h>

#include <utility>

#include "apps/live/local_socket.h"

namespace palpa::bench {
namespace {

constexpr std::int64_t kPicture = 66'000'000;  // ns, as a session tells them

}  // namespace

Onlookers::Onlookers(int pages)
    : path_(live::socketFolder() + "/bench-" + std::to_string(::getpid()) + ".sock"),
      port_(path_, log_, [](const std::string&) {}),
      link_(path_) {
  for (int i = 0; i < pages; ++i) pages_.emplace_back([this] { look(); });
}

Onlookers::~Onlookers() {
  ending_ = true;
  for (std::thread& page : pages_) page.join();
}

void Onlookers::show(scene::Image picture) {
  next_ns_ = clock_.now() + kPicture;
  port_.offer(std::move(picture));
  log_.addCurve(
      R"({"kind":"curve","t_s":[1.02,1.04,1.06],"force_N":[0.51,0.52,0.53],"depth_mm":[12.1,12.2,12.3]})");
}

void Onlookers::look() {
  live::giveWay();
  std::string page;
  for (std::uint64_t last = 0; !ending_;) {
    const console::SessionLink::Picture picture =
        link_.picture(last, std::chrono::milliseconds(200));
    if (!picture.jpeg) continue;
    last = picture.number;
    page = *picture.jpeg;
    ++pictures_;
  }
}

}  // namespace palpa::bench
