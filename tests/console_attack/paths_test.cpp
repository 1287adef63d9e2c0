// Out of the folders that are shown, by every route that takes a name.
#include <unistd.h>

#include <fstream>

#include "attacked.h"

namespace palpa::console_attack {
namespace {

constexpr char kSecret[] = "S3CRET-that-nobody-may-read";

class Paths : public Attacked {};

TEST_F(Paths, NothingIsReadOutsideOfWhatIsShown) {
  const std::string id = session();
  std::ofstream(console().home() / "secret.html") << kSecret;
  std::ofstream(folder() / "secret.html") << kSecret;
  std::ofstream(console().home() / "sessions" / id / "secret.html") << kSecret;
  fs::create_symlink(folder() / "secret.html",
                     console().home() / "sessions" / id / "view-secret.png");
  const std::string routes[] = {"/",
                                "/static/",
                                "/api/sessions/",
                                "/api/sessions/" + id + "/file/",
                                "/api/sessions/" + id + "/trials/1/frame/",
                                "/api/sessions/" + id + "/trials/",
                                "/api/pages/",
                                "/api/jobs/",
                                "/api/trainees/",
                                "/api/studies/",
                                "/api/cohort?group="};
  const std::string names[] = {"../secret.html",
                               "..%2fsecret.html",
                               "%2e%2e/secret.html",
                               "%2e%2e%2fsecret.html",
                               "%252e%252e%252fsecret.html",
                               "..%252fsecret.html",
                               "..\\secret.html",
                               "..%5csecret.html",
                               "..%c0%afsecret.html",
                               "..%ef%bc%8fsecret.html",
                               "....//secret.html",
                               "..;/secret.html",
                               "secret.html",
                               "secret.html%00.png",
                               "view-a%00.png",
                               "%00",
                               "report.html%00",
                               "%2fetc%2fpasswd",
                               "/etc/passwd",
                               "//etc/passwd",
                               "file:///etc/passwd",
                               "../../../../../../etc/passwd",
                               "..%2f..%2f..%2f..%2f..%2f..%2fetc%2fpasswd",
                               "console.json",
                               "log.txt",
                               "session.palpa",
                               "../../settings.json",
                               "../console.json",
                               "view-secret.png",
                               "view-..%2f..%2fsecret.png",
                               "%",
                               "%zz",
                               "%u002e",
                               "~",
                               "*",
                               "a b",
                               "%0d%0aSet-Cookie:%20x=1",
                               std::string(300, 'a'),
                               "-1",
                               "99999",
                               "00001"};
  int asked = 0;
  for (const std::string& route : routes)
    for (const std::string& name : names) {
      const Answer answer = console().raw(requestOf("GET", route + name, console().readHeaders()));
      ++asked;
      const bool group = route.find('?') != std::string::npos;
      EXPECT_TRUE(answer.status >= 400 && answer.status < 500)
          << route << name << ' ' << answer.status << (group ? " (nobody is of this group)" : "");
      EXPECT_EQ(answer.body.find(kSecret), std::string::npos) << route << name;
      EXPECT_EQ(answer.body.find("root:"), std::string::npos) << route << name;
      EXPECT_EQ(answer.header("Set-Cookie"), "") << route << name;
      EXPECT_EQ(answer.header("Content-Type"), "application/json") << route << name;
      EXPECT_EQ(answer.header("X-Content-Type-Options"), "nosniff");
    }
  EXPECT_EQ(asked, 11 * 41);
  EXPECT_TRUE(isNoted("404 no such path"));
  EXPECT_TRUE(goesOn());
}

TEST_F(Paths, WhatIsAbsoluteOrHasNoSlashIsNoPath) {
  for (const char* path : {"http://evil.example/", "http://127.0.0.1/etc/passwd", "*", "etc/passwd",
                           "?", "//evil.example/%2e%2e", "/%2e%2e/%2e%2e/etc/passwd"})
    EXPECT_GE(console().raw(requestOf("GET", path, console().readHeaders())).status, 400) << path;
}

}  // namespace
}  // namespace palpa::console_attack
