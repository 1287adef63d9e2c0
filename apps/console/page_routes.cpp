#include "apps/console/routes.h"
#include "apps/console/web/httplib_server.h"
#include "apps/console/web/own_door.h"
#include "apps/language/markup.h"

namespace palpa::console {
namespace {

using nlohmann::json;

constexpr char kChosen[] = "palpa-language";  // a cookie that the pages set

json listOfLanguages(const Console& c) {
  json all = json::array();
  for (const language::Language& one : c.languages.all())
    all.push_back({{"code", one.code}, {"name", one.name}, {"reviewed", one.reviewed}});
  return all;
}

}  // namespace

std::string languageOfWhoAsks(const Console& c, const httplib::Request& q) {
  return c.languages.best(cookieNamed(kChosen, q.get_header_value("Cookie")),
                          q.get_header_value("Accept-Language"));
}

void sendPage(Console& c, const httplib::Request& q, httplib::Response& r,
              const std::filesystem::path& file) {
  sendFile(r, file, mediaTypeOf(".html"));
  const auto language = c.languages.of(languageOfWhoAsks(c, q));
  if (!language->book.isEnglish()) r.body = language::pageIn(r.body, *language);
}

void addPages(WebServer& server, Console& c) {
  server.Get("/", [&c](const httplib::Request& q, httplib::Response& r) {
    sendPage(c, q, r, c.place.pages / "index.html");
  });
  server.Get("/static/languages.json", [&c](const httplib::Request&, httplib::Response& r) {
    answer(r, listOfLanguages(c));
  });
  server.Get(R"(/static/language-([a-z]{2,3}(?:-[A-Za-z]{2,4})?)\.json)",
             [&c](const httplib::Request& q, httplib::Response& r) {
               r.set_content(c.languages.catalogueJson(q.matches[1]), "application/json");
             });
  server.Get(R"(/static/([a-z0-9_-]{1,40}\.(?:js|css|svg)))",
             [&c](const httplib::Request& q, httplib::Response& r) {
               sendFile(r, c.place.pages / q.matches[1].str(), mediaTypeOf(q.matches[1]));
             });
}

}  // namespace palpa::console
