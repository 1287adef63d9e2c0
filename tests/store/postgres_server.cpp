#include "tests/store/postgres_server.h"

#include <arpa/inet.h>
#include <fcntl.h>
#include <grp.h>
#include <pwd.h>
#include <signal.h>
#include <sys/socket.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cstdlib>
#include <fstream>
#include <pqxx/pqxx>
#include <stdexcept>
#include <vector>

#include "apps/runtime/clock.h"

namespace palpa::test {
namespace {

namespace fs = std::filesystem;

constexpr char kPassword[] = "a throw-away secret";

/// The newest installed server's programs; empty: none.
fs::path programs() {
  fs::path newest;
  std::error_code none;
  for (const auto& version : fs::directory_iterator("/usr/lib/postgresql", none))
    if (fs::exists(version.path() / "bin/postgres") && (newest.empty() || version.path() > newest))
      newest = version.path();
  return newest.empty() ? newest : newest / "bin";
}

int freePort() {
  const int socket = ::socket(AF_INET, SOCK_STREAM, 0);
  sockaddr_in address{};
  address.sin_family = AF_INET;
  address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
  socklen_t size = sizeof address;
  if (::bind(socket, reinterpret_cast<sockaddr*>(&address), size) != 0 ||
      ::getsockname(socket, reinterpret_cast<sockaddr*>(&address), &size) != 0)
    throw std::runtime_error("no free port");
  ::close(socket);
  return ntohs(address.sin_port);
}

/// Starts a program as whoever may run the server.
pid_t spawn(const std::vector<std::string>& command, const fs::path& log) {
  const passwd* user = ::geteuid() == 0 ? ::getpwnam("postgres") : nullptr;
  const pid_t child = ::fork();
  if (child != 0) return child;
  const int output = ::open(log.c_str(), O_CREAT | O_WRONLY | O_APPEND, 0666);
  ::dup2(output, STDOUT_FILENO);
  ::dup2(output, STDERR_FILENO);
  if (user &&
      (::setgroups(0, nullptr) != 0 || ::setgid(user->pw_gid) != 0 || ::setuid(user->pw_uid) != 0))
    ::_exit(126);
  ::setenv("LC_ALL", "C", 1);
  if (::chdir("/") != 0) ::_exit(126);
  std::vector<char*> arguments;
  for (const std::string& word : command) arguments.push_back(const_cast<char*>(word.c_str()));
  arguments.push_back(nullptr);
  ::execv(arguments[0], arguments.data());
  ::_exit(127);
}

}  // namespace

std::string PostgresServer::whyNot() {
  if (programs().empty()) return "no PostgreSQL server is installed (Debian: postgresql)";
  if (::geteuid() == 0 && !::getpwnam("postgres"))
    return "the server refuses root and there is no user postgres";
  return "";
}

PostgresServer::PostgresServer() {
  std::string name = (fs::temp_directory_path() / "palpa-postgres-XXXXXX").string();
  if (!::mkdtemp(name.data())) throw std::runtime_error("no temporary folder");
  folder_ = name;
  std::ofstream(folder_ / "password") << kPassword;
  if (::geteuid() == 0) {
    const passwd* user = ::getpwnam("postgres");
    for (const fs::path& p : {folder_, folder_ / "password"})
      if (::chown(p.c_str(), user->pw_uid, user->pw_gid) != 0) throw std::runtime_error("chown");
  }
  int status = 0;
  ::waitpid(
      spawn({programs() / "initdb", "-D", folder_ / "data", "-U", "palpa", "-A", "scram-sha-256",
             "--pwfile", folder_ / "password", "--no-sync", "-E", "UTF8", "--locale=C"},
            folder_ / "initdb.log"),
      &status, 0);
  if (status != 0)
    throw std::runtime_error("initdb failed; see " + (folder_ / "initdb.log").string());
  ::setenv("PGPASSWORD", kPassword, 1);
  port_ = freePort();
  start();
  pqxx::connection connection(url("palpa", "postgres"));
  pqxx::nontransaction(connection).exec("CREATE DATABASE palpa");
}

PostgresServer::~PostgresServer() {
  kill();
  std::error_code ignored;
  fs::remove_all(folder_, ignored);
}

std::string PostgresServer::freshDatabase() {
  const std::string name = "fresh" + std::to_string(++databases_);
  pqxx::connection connection(url("palpa", "postgres"));
  pqxx::nontransaction(connection).exec("CREATE DATABASE " + name);
  return url("palpa", name);
}

std::string PostgresServer::url(const std::string& user, const std::string& database) const {
  return "postgresql://" + user + "@127.0.0.1:" + std::to_string(port_) + "/" + database;
}

std::string PostgresServer::localUrl() const {
  return "postgresql://palpa@/palpa?host=" + folder_.string() + "&port=" + std::to_string(port_);
}

void PostgresServer::start() {
  // Processes are killed here, not power: what was written is in the kernel's hands, and need not
  // be on the disk.
  process_ = spawn({programs() / "postgres", "-D", folder_ / "data", "-p", std::to_string(port_),
                    "-k", folder_, "-h", "127.0.0.1", "-c", "fsync=off"},
                   folder_ / "server.log");
  for (int tries = 600; tries > 0; --tries) {
    try {
      pqxx::connection connection(url("palpa", "postgres"));
      return;
    } catch (const pqxx::broken_connection&) {
      runtime::SteadyClock().sleepUntil(100 * runtime::kMillisecond);
    }
  }
  throw std::runtime_error("the server did not start");
}

/// Its children, one a client, end with it: SIGQUIT is "immediate shutdown", as if all had crashed.
void PostgresServer::kill() {
  if (process_ <= 0) return;
  ::kill(process_, SIGQUIT);
  ::waitpid(process_, nullptr, 0);
  process_ = -1;
}

}  // namespace palpa::test
