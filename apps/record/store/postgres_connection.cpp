#include <condition_variable>
#include <cstdio>
#include <limits>
#include <mutex>
#include <thread>

#include "apps/os/real_time.h"
#include "apps/os/socket.h"
#include "apps/record/store/postgres_library.h"
#include "apps/record/store/sql_connection.h"

namespace palpa::record {
namespace {

constexpr char kConnectSeconds[] = "10";
constexpr char kSilent_ms[] = "20000";  // a server behind a pulled cable is away after that
constexpr std::int64_t kSchemaLock = 0x70616c70615f72;  // any number, the same in all stations

std::string firstLine(const std::string& text) {
  const std::string line = text.substr(0, text.find('\n'));
  return line.empty() ? "no reason given" : line;
}

/// No TLS there, a certificate that is not the server's, or none at hand to check it with.
bool isAboutTls(const std::string& reason) {
  return reason.find("not support SSL") != std::string::npos ||
         reason.find("certificate") != std::string::npos;
}

bool isRefusal(const std::string& reason) {
  return isAboutTls(reason) || reason.find("password") != std::string::npos ||
         reason.find("authentication") != std::string::npos ||
         reason.find("does not exist") != std::string::npos;
}

std::string remedyFor(const std::string& reason) {
  if (isAboutTls(reason))
    return "Beyond this computer the server needs TLS: put the certificate of who signs its own "
           "into ~/.postgresql/root.crt, or name it: ?sslrootcert=FILE";
  if (reason.find("password") != std::string::npos ||
      reason.find("authentication") != std::string::npos)
    return "Check user and password (PGPASSWORD or ~/.pgpass)";
  if (reason.find("does not exist") != std::string::npos)
    return "Ask whoever runs the server to make it";
  return "Check network and server; trials are kept on this station and sent later";
}

/// Hangs up on a server that has taken a request and says nothing: libpq waits for ever there.
class SilenceWatch {
 public:
  explicit SilenceWatch(std::chrono::milliseconds most) : most_(most) {}
  ~SilenceWatch() {
    change([this] { over_ = true; });
    if (thread_.joinable()) thread_.join();
  }
  SilenceWatch(const SilenceWatch&) = delete;
  SilenceWatch& operator=(const SilenceWatch&) = delete;

  /// While it lives, an answer is waited for.
  class Request {
   public:
    Request(SilenceWatch& watch, int socket) : watch_(watch) {
      watch_.change([&] { watch_.socket_ = socket, ++watch_.request_; });
    }
    ~Request() {
      watch_.change([this] { watch_.socket_ = -1; });
    }
    Request(const Request&) = delete;
    Request& operator=(const Request&) = delete;

   private:
    SilenceWatch& watch_;
  };
  bool hasHungUp() {
    const std::lock_guard lock(mutex_);
    return hung_up_;
  }

 private:
  template <typename Change>
  void change(Change to) {
    {
      const std::lock_guard lock(mutex_);
      to();
      if (!over_ && !thread_.joinable()) thread_ = os::startThread([this] { run(); });
    }
    changed_.notify_all();
  }

  void run() {
    std::unique_lock lock(mutex_);
    while (!over_) {
      if (socket_ < 0)
        changed_.wait(lock, [this] { return over_ || socket_ >= 0; });
      else
        watch(lock);
    }
  }

  /// Of one request, as long as bytes come. A socket that keeps no count of that (a local one's
  /// server, which no cable can part from us) is waited for.
  void watch(std::unique_lock<std::mutex>& lock) {
    const auto over = [this, request = request_] {
      return over_ || socket_ < 0 || request_ != request;
    };
    for (std::chrono::milliseconds wait = most_; !changed_.wait_for(lock, wait, over);) {
      const std::chrono::milliseconds silent = silence();
      wait = most_ - silent;
      if (silent < most_) continue;
      os::endBoth(socket_);
      hung_up_ = true;
      socket_ = -1;
    }
  }

  std::chrono::milliseconds silence() const {
    return os::silentSince(socket_).value_or(std::chrono::milliseconds{0});
  }

  const std::chrono::milliseconds most_;
  std::mutex mutex_;
  std::condition_variable changed_;
  int socket_ = -1;  ///< on which an answer is waited for
  std::uint64_t request_ = 0;
  bool over_ = false, hung_up_ = false;
  std::thread thread_;
};

class PostgresConnection final : public SqlConnection {
 public:
  PostgresConnection(std::string url, Access access, std::chrono::milliseconds silence)
      : url_(std::move(url)), silence_(silence) {
    guarded([&] {
      const char* only_read =
          access == Access::read ? "&options=-c%20default_transaction_read_only%3Don" : "";
      const std::string safe = withEncryption(url_, serverDefaults());
      const bool has_options = safe.find('?') != std::string::npos;
      connection_ = std::make_unique<pqxx::connection>(
          safe + (has_options ? "&" : "?") + "connect_timeout=" + kConnectSeconds +
          "&tcp_user_timeout=" + kSilent_ms + "&client_encoding=UTF8&application_name=palpa" +
          only_read);
      postgres::stayLost(*connection_);
    });
  }

  SqlRows query(const std::string& sql, const std::vector<SqlValue>& values) override {
    return rowsOf(ask(sql, values));
  }
  std::unique_ptr<SqlCursor> cursor(const std::string& sql,
                                    const std::vector<SqlValue>& values) override {
    return std::make_unique<Cursor>(*this, sql, values);
  }

  void script(const std::string& statements) override {
    guarded([&] { work_->exec(statements); });
  }
  void begin(Access access) override {
    guarded([&] { work_ = std::make_unique<pqxx::work>(*connection_); });
    if (access == Access::read) script("SET TRANSACTION ISOLATION LEVEL REPEATABLE READ READ ONLY");
  }
  void commit() override {
    const std::unique_ptr<pqxx::work> work = std::move(work_);
    guarded([&] { work->commit(); });
  }
  void rollback() noexcept override {
    try {
      const SilenceWatch::Request request(silence_, connection_->sock());
      work_.reset();
    } catch (...) {  // the server rolls back by itself
    }
  }
  void lockSchema() override { query("SELECT pg_advisory_xact_lock($1)", {kSchemaLock}); }
  bool leaveNoTrace() override { return true; }
  bool hasTable(const std::string& name) override {
    return !query(
                "SELECT 1 FROM information_schema.tables WHERE table_schema=current_schema() AND "
                "table_name=$1",
                {name})
                .empty();
  }
  std::string place() const override { return "records server " + url_; }

 private:
  /// Of the server: asked for a thousand rows, it keeps its place among them.
  class Cursor final : public SqlCursor {
   public:
    Cursor(PostgresConnection& owner, const std::string& sql, const std::vector<SqlValue>& values)
        : owner_(owner), name_("palpa_" + std::to_string(++owner.cursors_)) {
      owner_.ask("DECLARE " + name_ + " NO SCROLL CURSOR FOR " + sql, values);
    }
    ~Cursor() override {
      try {
        if (owner_.work_) owner_.ask("CLOSE " + name_, {});
      } catch (...) {  // it ends with its transaction
      }
    }
    bool next() override {
      if (++at_ < rows_.size()) return true;
      rows_ = pqxx::result();  // given up before the next come
      rows_ = owner_.ask("FETCH 1000 FROM " + name_, {});
      at_ = 0;
      return !rows_.empty();
    }
    std::string_view text(std::size_t column) const override {
      const pqxx::field field = fieldOf(column);
      return field.is_null() ? std::string_view() : std::string_view(field.c_str(), field.size());
    }
    std::int64_t integer(std::size_t column) const override {
      return fieldOf(column).as<std::int64_t>(0);
    }
    double real(std::size_t column) const override {
      return fieldOf(column).as<double>(std::numeric_limits<double>::quiet_NaN());
    }
    std::vector<SqlValue> row() const override { return postgres::valuesOf(rows_[at_]); }

   private:
    pqxx::field fieldOf(std::size_t column) const {
      return rows_[at_][static_cast<pqxx::row::size_type>(column)];
    }
    PostgresConnection& owner_;
    const std::string name_;
    pqxx::result rows_;
    pqxx::result::size_type at_ = 0;
  };

  pqxx::result ask(const std::string& sql, const std::vector<SqlValue>& values) {
    return guarded([&] {
      if (work_) return postgres::execute(*work_, sql, values);
      pqxx::nontransaction alone(*connection_);
      return postgres::execute(alone, sql, values);
    });
  }

  static SqlRows rowsOf(const pqxx::result& result) {
    SqlRows rows;
    for (const pqxx::row& row : result) rows.add(postgres::valuesOf(row));
    return rows;
  }

  /// A connection that is lost stays lost: whoever asks again makes a new one.
  void requireConnection() {
    if (!connection_) return;  // it is being made
    if (silence_.hasHungUp()) throw StoreUnreachable("does not answer", place(), remedyFor(""));
    if (!connection_->is_open()) throw StoreUnreachable("was lost", place(), remedyFor(""));
  }

  /// What goes wrong, in words; whether trying again later can help.
  template <typename Action>
  auto guarded(Action action) -> decltype(action()) {
    requireConnection();
    try {
      const SilenceWatch::Request request(silence_, connection_ ? connection_->sock() : -1);
      return action();
    } catch (const pqxx::broken_connection& e) {
      if (silence_.hasHungUp()) throw StoreUnreachable("does not answer", place(), remedyFor(""));
      const std::string reason = firstLine(e.what());
      if (isRefusal(reason))
        throw Error("refuses the connection (" + reason + ")", place(), remedyFor(reason));
      throw StoreUnreachable("cannot be reached (" + reason + ")", place(), remedyFor(reason));
    } catch (const pqxx::in_doubt_error& e) {  // the server may have it; asking again does no harm
      throw StoreUnreachable("was lost while it confirmed (" + firstLine(e.what()) + ")", place(),
                             remedyFor(""));
    } catch (const pqxx::transaction_rollback& e) {
      throw StoreUnreachable(
          "received the same request from another station (" + firstLine(e.what()) + ")", place(),
          "It is tried again");
    } catch (const pqxx::disk_full& e) {
      throw StoreUnreachable("has a full disk (" + firstLine(e.what()) + ")", place(),
                             "Free space there; trials are kept on this station and sent later");
    } catch (const pqxx::sql_error& e) {
      const std::string reason = firstLine(e.what());
      if (e.sqlstate().starts_with("57P") || e.sqlstate().starts_with("08"))
        throw StoreUnreachable("went away (" + reason + ")", place(), remedyFor(""));
      throw Error("answered with an error (" + reason + ")", place(),
                  "Check that this user may read and write there");
    } catch (const pqxx::failure& e) {
      throw Error("answered with an error (" + firstLine(e.what()) + ")", place(),
                  "Check that this user may read and write there");
    } catch (const postgres::LogicFailure& e) {
      throw Error("could not be understood (" + firstLine(postgres::reasonOf(e)) + ")", place(),
                  "Report this");
    }
  }

  const std::string url_;
  SilenceWatch silence_;
  std::unique_ptr<pqxx::connection> connection_;
  std::unique_ptr<pqxx::work> work_;
  unsigned cursors_ = 0;  ///< made so far
};

}  // namespace

std::unique_ptr<SqlConnection> openPostgres(const std::string& url, Access access,
                                            std::chrono::milliseconds silence) {
  return std::make_unique<PostgresConnection>(url, access, silence);
}

}  // namespace palpa::record
