#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

namespace palpa::room {

/// A console that somebody announces on the local network. Anybody there can say anything: it is
/// shown, and nothing is done because of it.
struct FoundConsole {
  std::string name;     ///< under which it is announced
  std::string host;     ///< "desk.local"
  std::string station;  ///< its name in a room; empty: it is in none
  std::string version;  ///< of Palpa there
  int port = 0;
  bool watches = false;  ///< it is no station: it watches a room
  bool operator==(const FoundConsole&) const = default;
};

/// As the network tells it.
struct TxtOfService {
  std::string name, host;
  int port = 0;
  std::vector<std::string> txt;  ///< "key=value"
};
/// What a console says of itself, as it is announced.
std::vector<std::string> txtOf(const FoundConsole& console);
/// Nothing for what cannot be shown: no name of a service or host, no port. Of the rest what is no
/// station's name, or no version, is left out.
std::optional<FoundConsole> consoleIn(const TxtOfService& service);

/// Those that are there now, by their names and networks; no more than kMost.
class FoundConsoles {
 public:
  static constexpr std::size_t kMost = 200;
  bool isFull() const { return all_.size() >= kMost; }
  /// `network`: of the interface and protocol by which it was heard.
  void add(const std::string& network, const FoundConsole& console);
  void remove(const std::string& network, const std::string& name);
  void clear() { all_.clear(); }
  /// By name; one that several networks tell of is told once.
  std::vector<FoundConsole> all() const;

 private:
  std::map<std::pair<std::string, std::string>, FoundConsole> all_;  ///< name, network
};

}  // namespace palpa::room
