#include "apps/record/store/sql_connection.h"

#include <gtest/gtest.h>

#include "anatomy/base/error.h"

namespace palpa::record {
namespace {

std::string whyRefused(const std::string& address) {
  try {
    requireAddress(address);
  } catch (const UsageError& e) {
    return e.what();
  }
  return "";
}

TEST(RecordsAddress, FilesAndServersPass) {
  for (const char* address :
       {"/home/me/records.sqlite", "records.sqlite", "runs/rate=0.1/records.sqlite",
        "the host of the course.sqlite", "postgresql://me@host/db", "postgres://host/db",
        "postgresql:///db?host=/run/postgresql", "postgresql://h/db?passfile=/home/me/pass"})
    EXPECT_EQ(whyRefused(address), "") << address;
}

TEST(RecordsAddress, SettingsAsWordsAndOtherSchemesAreRefusedWithoutTheirSecret) {
  for (const char* address :
       {"host=server password=geheim", "dbname=x host=y password=geheim", "password = geheim",
        "  user=me password=geheim", "mysql://me:geheim@host/db", "http://geheim",
        "geheim stuff://x", "postgresql://me:geheim@host/db", "postgresql://h/db?password=geheim",
        "postgresql://h/db?%70assword=geheim", "postgresql://h/db?x=y&sslpassword=geheim"}) {
    const std::string refusal = whyRefused(address);
    EXPECT_NE(refusal, "") << address;
    EXPECT_EQ(refusal.find("geheim"), std::string::npos) << refusal;
  }
  EXPECT_NE(whyRefused("mysql://h/db").find("mysql://"), std::string::npos);
}

/// As libpq reads an address: what stands before the first "@" is user and password, whatever it
/// holds.
TEST(RecordsAddress, APasswordHidesTheServerBehindNoSign) {
  EXPECT_NE(whyRefused("postgresql://ann:ge?heim@db.example/records"), "");
  EXPECT_NE(whyRefused("postgresql://ann:ge,heim@db.example/records"), "");
  EXPECT_EQ(withEncryption("postgresql://localhost?@db.example/r", {}),
            "postgresql://localhost?@db.example/r?sslmode=verify-full");
  EXPECT_EQ(withEncryption("postgresql://us?er@db.example/r", {}),
            "postgresql://us?er@db.example/r?sslmode=verify-full");
}

constexpr char kFull[] = "sslmode=verify-full";

TEST(RecordsAddress, OnThisComputerItStaysAsItIs) {
  for (const char* address :
       {"postgresql://me@localhost/db", "postgresql://127.0.0.1:5433/db",
        "postgresql://127.8.9.1/db", "postgresql://me@[::1]:5432/db", "postgresql:///db",
        "postgresql://%2Frun%2Fpostgresql/db", "postgresql:///db?host=/tmp",
        "postgresql://localhost/db?sslmode=disable", "postgresql://localhost,127.0.0.1:1/db",
        "postgresql://faraway/db?host=localhost"})
    EXPECT_EQ(withEncryption(address, {}), address);
}

TEST(RecordsAddress, BeyondItTheCertificateIsChecked) {
  for (const char* address :
       {"postgresql://me@server/db", "postgres://10.0.0.7:5432/db",
        "postgresql://localhost.example.org/db", "postgresql://127.0.0.1.example.org/db",
        "postgresql://[fe80::1]/db", "postgresql://localhost,server/db", "postgresql://me:x@server",
        "postgresql://%73erver/db"})
    EXPECT_EQ(withEncryption(address, {}), std::string(address) + "?" + kFull);
  for (const char* address :
       {"postgresql://localhost/db?host=server", "postgresql:///db?hostaddr=10.0.0.7",
        "postgresql://localhost/db?hostaddr=10.0.0.7", "postgresql://localhost/db?service=centre"})
    EXPECT_EQ(withEncryption(address, {}), std::string(address) + "&" + kFull);
}

TEST(RecordsAddress, WhatTheEnvironmentNamesCountsAsWell) {
  const std::string nobody = "postgresql:///db", here = "postgresql://localhost/db";
  const std::string asks = std::string("?") + kFull;
  EXPECT_EQ(withEncryption(nobody, {.host = "server"}), nobody + asks);
  EXPECT_EQ(withEncryption(nobody, {.host = "/run/postgresql"}), nobody);
  EXPECT_EQ(withEncryption(here, {.host = "server"}), here) << "the address says where";
  EXPECT_EQ(withEncryption(here, {.number = "10.0.0.7"}), here + asks) << "it counts all the same";
  EXPECT_EQ(withEncryption(here, {.service = "centre"}), here + asks);
}

TEST(RecordsAddress, LessThanThatIsRefusedThere) {
  for (const char* mode : {"disable", "allow", "prefer", "require", ""})
    EXPECT_THROW(withEncryption(std::string("postgresql://server/db?sslmode=") + mode, {}),
                 UsageError)
        << mode;
  EXPECT_THROW(withEncryption("postgresql://server/db?%73slmode=disable", {}), UsageError);
  EXPECT_THROW(withEncryption("postgresql://server/db?sslmode=verify-full&sslmode=disable", {}),
               UsageError);
  for (const char* mode : {"verify-ca", "verify-full"}) {
    const std::string address = std::string("postgresql://server/db?x=1&sslmode=") + mode;
    EXPECT_EQ(withEncryption(address, {}), address);
  }
}

}  // namespace
}  // namespace palpa::record
