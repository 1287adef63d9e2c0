#include <gtest/gtest.h>

#include <cerrno>

#include "fake_net_ft.h"
#include "haptics/sensors/net_ft_sensor.h"

namespace palpa::haptics {
namespace {

/// The message with which opening and starting fails; empty: it did not.
std::string failure(NetFtSettings settings) {
  settings.answer_tries = 2;
  settings.answer_wait_ms = 20;
  try {
    NetFtSensor sensor(settings, [] { return 0; });
    sensor.start();
  } catch (const Error& error) {
    return error.what();
  }
  return "";
}

NetFtSettings at(std::uint16_t port) {
  NetFtSettings settings;
  settings.address = "127.0.0.1";
  settings.port = port;
  return settings;
}

bool says(const std::string& message, const std::string& words) {
  return message.find(words) != std::string::npos;
}

TEST(NetFtErrors, NothingAnswers) {
  FakeNetFt mute(Bytes{});
  const std::string message = failure(at(mute.port()));
  EXPECT_TRUE(says(message, "nothing answers")) << message;
  EXPECT_TRUE(says(message, "127.0.0.1:" + std::to_string(mute.port()))) << message;
  EXPECT_TRUE(mute.heard(kStartBytes, 2)) << "asked as often as stated";
}

TEST(NetFtErrors, NobodyListens) {
  std::uint16_t port = 0;
  { port = FakeNetFt().port(); }
  const std::string message = failure(at(port));
  EXPECT_TRUE(says(message, "does not listen")) << message;
}

TEST(NetFtErrors, WhatAnswersIsNoRdt) {
  FakeNetFt other(Bytes{'h', 'e', 'l', 'l', 'o'});
  const std::string message = failure(at(other.port()));
  EXPECT_TRUE(says(message, "does not speak RDT")) << message;
}

TEST(NetFtErrors, TheLocalPortIsTaken) {
  FakeNetFt server, other;
  NetFtSettings settings = at(server.port());
  settings.local_port = other.port();
  const std::string message = failure(settings);
  EXPECT_TRUE(says(message, "local port is taken")) << message;
}

TEST(NetFtErrors, NoRouteSaysWhatToCheck) {
  for (const int error : {ENETUNREACH, EHOSTUNREACH}) {
    const std::string message = networkError(error, "force sensor 10.0.0.1:49152").what();
    EXPECT_TRUE(says(message, "force sensor 10.0.0.1:49152: no route")) << message;
    EXPECT_TRUE(says(message, "cable")) << message;
  }
}

TEST(NetFtErrors, SettingsThatCannotBeAreUsage) {
  FakeNetFt server;
  NetFtSettings name = at(server.port()), scale = name, wait = name;
  name.address = "sensor.local";
  scale.scale.counts_per_Nm = 0;
  wait.wait_ms = 0;
  for (const NetFtSettings& settings : {name, scale, wait})
    EXPECT_THROW(NetFtSensor(settings, [] { return 0; }), UsageError);
}

TEST(NetFtErrors, OpenedButNotStartedSendsNothing) {
  FakeNetFt server;
  {
    NetFtSensor sensor(at(server.port()), [] { return 0; });
  }
  NetFtSensor marker(at(server.port()), [] { return 0; });
  marker.start();
  EXPECT_EQ(server.requests(), std::vector<Bytes>{kStartBytes})
      << "a stop would end another program's stream";
}

}  // namespace
}  // namespace palpa::haptics
