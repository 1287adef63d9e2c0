#pragma once

#include <gtest/gtest.h>
#include <pthread.h>

namespace palpa::test {

/// While it lives the system gives this program no further thread: each would get a stack that has
/// no place.
class NoThreads {
 public:
  NoThreads() {
    pthread_getattr_default_np(&before_);
    pthread_attr_t boundless;
    pthread_attr_init(&boundless);
    pthread_attr_setstacksize(&boundless, std::size_t{1} << 47);
    EXPECT_EQ(pthread_setattr_default_np(&boundless), 0);
    pthread_attr_destroy(&boundless);
  }
  ~NoThreads() {
    pthread_setattr_default_np(&before_);
    pthread_attr_destroy(&before_);
  }
  NoThreads(const NoThreads&) = delete;
  NoThreads& operator=(const NoThreads&) = delete;

 private:
  pthread_attr_t before_;
};

}  // namespace palpa::test
