#pragma once

#include <filesystem>
#include <string>

#include <sys/types.h>

namespace palpa::test {

/// A PostgreSQL server of its own in a temporary folder, thrown away at the end: one user "palpa"
/// with a password, an empty database "palpa". It listens on 127.0.0.1 and on a Unix socket in its
/// folder. As root it runs as the user "postgres", since the server refuses root.
class PostgresServer {
 public:
  /// Empty: it can run here. Otherwise the reason, for a test to skip with.
  static std::string whyNot();

  PostgresServer();
  ~PostgresServer();
  PostgresServer(const PostgresServer&) = delete;
  PostgresServer& operator=(const PostgresServer&) = delete;

  /// Sets PGPASSWORD for this process, as a station would have it.
  std::string url(const std::string& user = "palpa", const std::string& database = "palpa") const;
  std::string localUrl() const;  ///< of "palpa" by its Unix socket
  std::string freshDatabase();   ///< url of another, empty one
  void start();
  void kill();  ///< at once, without a farewell to its clients

 private:
  std::filesystem::path folder_;
  int port_ = 0;
  pid_t process_ = -1;
  int databases_ = 0;
};

}  // namespace palpa::test
