#include <gtest/gtest.h>

#include <algorithm>
#include <cctype>
#include <regex>
#include <set>

#include "include_arrows.h"

namespace palpa::house {
namespace {

/// What the operating system is asked stands in one folder; the drivers, two adapters that load
/// foreign libraries, and the one way to write a file and to leave what hangs, lie below it and may
/// not include it.
bool mayAskTheSystem(const std::string& path) {
  const std::string asking[] = {"apps/os/",
                                "anatomy/base/whole_file.cpp",
                                "haptics/devices/",
                                "haptics/sensors/",
                                "anatomy/base/left_behind.cpp",
                                "ar/codecs/codecs.cpp",
                                "scene/window/stand_ins.cpp"};
  return std::any_of(std::begin(asking), std::end(asking),
                     [&](const std::string& place) { return path.rfind(place, 0) == 0; });
}

bool isOfTheSystem(const std::string& header) {
  static const std::regex kSystem(
      "(sys|arpa|netinet|linux)/.*|(unistd|fcntl|signal|spawn|poll|netdb|pthread|sched|dlfcn)\\.h|"
      "csignal");
  return std::regex_match(header, kSystem);
}

/// Calls of Linux that come with the language's own headers, or with those above.
bool isACall(const std::string& name) {
  static const std::set<std::string> kCalls{std::string("clock_") + "gettime",
                                            "clock_nanosleep",
                                            "mkdtemp",
                                            "mkstemps",
                                            "flock",
                                            "isatty",
                                            "getpid",
                                            "geteuid",
                                            "waitpid"};
  return kCalls.count(name) > 0;
}

bool canStandInAName(char c) { return std::isalnum(static_cast<unsigned char>(c)) || c == '_'; }

bool namesACall(const std::string& code) {
  for (auto begin = code.begin(); begin != code.end();) {
    const auto end = std::find_if_not(begin, code.end(), canStandInAName);
    if (isACall({begin, end})) return true;
    begin = std::find_if(end, code.end(), canStandInAName);
  }
  return false;
}

/// What `file` asks the system, in words; empty: nothing, or it may.
std::vector<std::string> systemCalls(const SourceFile& file) {
  std::vector<std::string> calls;
  if (!file.isProduct() || mayAskTheSystem(file.path)) return calls;
  for (const auto& [header, quoted] : includesOf(file.text))
    if (!quoted && isOfTheSystem(header)) calls.push_back(file.path + " includes " + header);
  if (namesACall(withoutComments(file.text))) calls.push_back(file.path + " calls the system");
  return calls;
}

std::size_t callsIn(const std::string& path, const std::string& code) {
  return systemCalls({path, code}).size();
}

TEST(SystemCalls, StandInOneFolderAndTheDrivers) {
  for (const SourceFile& file : sourceTree(PALPA_SOURCE_DIR))
    for (const std::string& line : systemCalls(file)) ADD_FAILURE() << line;
}

TEST(SystemCalls, PlantedHeaderIsCaught) {
  for (const char* header : {"unistd.h", "sys/socket.h", "fcntl.h", "signal.h", "csignal",
                             "spawn.h", "poll.h", "netinet/in.h", "arpa/inet.h", "netdb.h",
                             "pthread.h", "sched.h", "dlfcn.h", "linux/capability.h"})
    EXPECT_EQ(callsIn("apps/console/a.cpp", "#include <" + std::string(header) + ">\n"), 1u)
        << header;
}

TEST(SystemCalls, PlantedCallIsCaught) {
  EXPECT_EQ(callsIn("apps/cli/a.cpp", "const bool terminal = isatty(2);"), 1u);
  EXPECT_EQ(callsIn("apps/record/a.cpp", "if (!::mkdtemp(name.data())) return;"), 1u);
  EXPECT_EQ(callsIn("scene/a.h", "std::to_string(getpid())"), 1u);
}

TEST(SystemCalls, WhereTheyAreAtHomeTheyPass) {
  const std::string code = "#include <unistd.h>\nint a = getpid();\n";
  for (const char* home : {"apps/os/a.cpp", "haptics/sensors/a.cpp", "haptics/devices/falcon/a.cpp",
                           "tests/store/a.cpp"})
    EXPECT_EQ(callsIn(home, code), 0u) << home;
  EXPECT_EQ(callsIn("apps/osmosis/a.cpp", code), 2u);
}

TEST(SystemCalls, OtherHeadersNamesAndCommentsPass) {
  EXPECT_EQ(callsIn("apps/cli/a.cpp", "#include <vector>\n#include \"apps/os/signals.h\"\n"), 0u);
  EXPECT_EQ(callsIn("apps/cli/a.cpp", "// #include <unistd.h>, then getpid()\nint forked = 0;"),
            0u);
}

}  // namespace
}  // namespace palpa::house
