#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "apps/link/web_client.h"

namespace palpa::learning {

/// Of requests to a platform.
inline constexpr link::WebTimes kPlatformTimes{5, 10, 15};

enum class PlatformKind { cmi5, lti };

/// A learning management system that may launch tasks here.
struct Platform {
  std::string name;  ///< letters, digits, - and _
  PlatformKind kind = PlatformKind::cmi5;
  /// cmi5: "https://lms.example", from which launches come and to which statements go.
  std::string origin = "";
  /// LTI: as the platform tells when the tool is registered there.
  std::string issuer = "", client_id = "", login = "", token = "", keys = "";
  std::vector<std::string> deployments = {};
};

/// What of learning management systems a console knows. Nothing, and there is none.
struct Settings {
  std::string address;               ///< of this console for their browsers, ending in "/"
  std::string performer = "person";  ///< of launched sessions: person, expert, novice
  int trials = 1;                    ///< of each
  std::vector<Platform> platforms = {};

  bool isOff() const { return platforms.empty(); }
  const Platform* named(const std::string& name) const;
  /// Of cmi5: whose origin this address has; null: nobody's.
  const Platform* ofOrigin(const std::string& url) const;
};

/// What belongs to learning management systems in a console's folder.
struct Folder {
  explicit Folder(const std::filesystem::path& home) : path(home / "learning") {}
  std::filesystem::path settings() const { return path / "settings.json"; }
  std::filesystem::path key() const { return path / "key.json"; }
  std::filesystem::path launches() const { return path / "launches.sqlite"; }
  std::filesystem::path statements() const { return path / "statements.sqlite"; }
  const std::filesystem::path path;
};

/// Off where there are none. Throws Error for a file that holds none.
Settings readSettings(const Folder& folder);
/// For its owner alone.
void writeSettings(const Folder& folder, const Settings& settings);
/// Throws UsageError for what no platform can be: a name, an address, something missing.
void requireUsable(const Settings& settings);

/// "https://lms.example:8443" of an address; throws UsageError for one that is none, holds a
/// password, or is http beyond this computer.
std::string originOf(const std::string& url);
/// Where a request to an address goes, and its path with the query. Throws as above.
struct Target {
  link::Endpoint server;
  std::string path;
};
Target targetOf(const std::string& url);

}  // namespace palpa::learning
