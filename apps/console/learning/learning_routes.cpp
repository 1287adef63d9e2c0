#include <algorithm>

#include "anatomy/base/error.h"
#include "anatomy/base/utc.h"
#include "apps/console/learning/learning_desk.h"
#include "apps/console/routes.h"
#include "apps/language/markup.h"

/// What browsers that a learning management system sends ask for: LAUNCH is the key, no token of
/// the console is.
namespace palpa::console {
namespace {

using learning::Fields;
using learning::Launch;

constexpr char kBrowser[] = "palpa-launch";  // a cookie

Fields fieldsOf(const httplib::Request& q) { return {q.params.begin(), q.params.end()}; }

struct Words {
  std::string title, words;
  int again_s = 0;        ///< then the page asks again, or follows its link, by itself; 0: never
  std::string link = "";  ///< back to the course
};

void say(Console& c, const httplib::Request& q, httplib::Response& r, const Words& page,
         int status = 200) {
  r.status = status;
  if (page.again_s > 0)
    r.set_header("Refresh",
                 std::to_string(page.again_s) + (page.link.empty() ? "" : "; url=" + page.link));
  r.body = learning::pageOfWords(page.title, page.words, page.link);
  const auto language = c.languages.of(languageOfWhoAsks(c, q));
  if (!language->book.isEnglish()) r.body = language::pageIn(r.body, *language);
  r.set_header("Content-Type", "text/html; charset=utf-8");
}

/// Runs what a launch asks for; whatever is wrong with it becomes a page.
template <class Work>
void attempt(Console& c, const httplib::Request& q, httplib::Response& r, const Work& work) {
  try {
    if (c.learning->settings().isOff())
      return say(c, q, r,
                 {"Not launched",
                  "This console is not connected to a learning management system. The educator "
                  "can do that at the station: palpa console learning --help"},
                 404);
    work();
  } catch (const UsageError& e) {
    say(c, q, r, {"Not launched", e.what()}, 403);
  } catch (const Error& e) {
    say(c, q, r, {"Not launched", e.what()}, 500);
  }
}

void goTo(httplib::Response& r, const std::string& address) {
  r.status = 303;
  r.set_header("Location", address);
}

void launchCmi5(Console& c, const httplib::Request& q, httplib::Response& r) {
  // Before the platform is asked: its key is for one use.
  if (c.sessions.oneRuns())
    return say(c, q, r,
               {"The station is in use",
                "A session is running there. This page begins yours as soon as it is over.", 5});
  goTo(r, "/learning/launch/" +
              c.learning->launchCmi5(fieldsOf(q), q.matches[1], languageOfWhoAsks(c, q)));
}

void beginLti(Console& c, const httplib::Request& q, httplib::Response& r) {
  const learning::Settings settings = c.learning->settings();
  const auto begun = c.learning->logins().begin(learning::readLogin(fieldsOf(q), settings),
                                                settings, utcSecondsOf(utcNow()));
  r.set_header("Set-Cookie", c.guard.cookieForLaunch(kBrowser, begun.browser));
  goTo(r, begun.address);
}

void launchLti(Console& c, const httplib::Request& q, httplib::Response& r) {
  const Fields fields = fieldsOf(q);
  const std::string trouble = learning::fieldIn(fields, "error");
  if (!trouble.empty())
    throw UsageError("refused the login", "the learning platform", "Start again from the course");
  const auto login = c.learning->logins().take(learning::neededIn(fields, "state"),
                                               cookieNamed(kBrowser, q.get_header_value("Cookie")),
                                               utcSecondsOf(utcNow()));
  constexpr std::size_t kLongestToken = 32u << 10;
  goTo(r, "/learning/launch/" +
              c.learning->launchLti(learning::neededIn(fields, "id_token", kLongestToken), login,
                                    languageOfWhoAsks(c, q)));
}

Words wordsOf(const Launch& launch) {
  constexpr int kToBeRead_s = 10;
  if (!launch.over)
    return {launch.title,
            "Your session is prepared. Go to the station: it begins there, with the key Enter or "
            "the device's button. This page tells what came of it.",
            3};
  if (launch.isDone())
    return {launch.title, launch.result + " Your course has it.",
            launch.return_url.empty() ? 0 : kToBeRead_s, launch.return_url};
  if (launch.trouble.empty())
    return {launch.title, launch.result + " It is being sent to your course.", 3};
  return {launch.title,
          launch.result + " Your course did not take it; the educator has it in the records.", 0,
          launch.return_url};
}

void show(Console& c, const httplib::Request& q, httplib::Response& r) {
  const auto launch = c.learning->find(q.matches[1]);
  if (!launch) return say(c, q, r, {"Not here", "There is no such launch."}, 404);
  say(c, q, r, wordsOf(*launch));
}

}  // namespace

void addLearningRoutes(WebServer& server, Console& c) {
  server.Get(R"(/learning/cmi5/([A-Za-z0-9_-]{1,64}))",
             [&c](const httplib::Request& q, httplib::Response& r) {
               attempt(c, q, r, [&] { launchCmi5(c, q, r); });
             });
  const auto login = [&c](const httplib::Request& q, httplib::Response& r) {
    attempt(c, q, r, [&] { beginLti(c, q, r); });
  };
  server.Get("/learning/lti/login", login);
  server.Post("/learning/lti/login", login);
  server.Post("/learning/lti/launch", [&c](const httplib::Request& q, httplib::Response& r) {
    attempt(c, q, r, [&] { launchLti(c, q, r); });
  });
  server.Get("/learning/keys", [&c](const httplib::Request& q, httplib::Response& r) {
    attempt(c, q, r, [&] { answer(r, c.learning->publicKeys()); });
  });
  server.Get(R"(/learning/launch/([0-9a-f-]{36}))",
             [&c](const httplib::Request& q, httplib::Response& r) {
               attempt(c, q, r, [&] { show(c, q, r); });
             });
}

}  // namespace palpa::console
