#include "apps/console/routes.h"

namespace palpa::console {
namespace {

constexpr std::chrono::milliseconds kPatience{1000};
constexpr char kBoundary[] = "palpa-picture";

bool write(httplib::DataSink& sink, const std::string& bytes) {
  return sink.is_writable() && sink.write(bytes.data(), bytes.size());
}

/// Server-sent events: every entry with its number; whoever was away says the last that he has
/// (Last-Event-ID) and gets the rest.
void sendEvents(WebServer& server, const std::shared_ptr<SessionLink>& link, std::size_t from,
                httplib::Response& response) {
  response.set_header("X-Accel-Buffering", "no");
  response.set_chunked_content_provider(
      "text/event-stream",
      [&server, link, next = from](std::size_t, httplib::DataSink& sink) mutable {
        if (server.ending()) return false;
        const SessionLink::News news = link->wait(next, kPatience);
        next = news.from;
        std::string out;
        for (const std::string& entry : news.entries)
          out += "id: " + std::to_string(++next) + "\ndata: " + entry + "\n\n";
        if (out.empty()) out = ": here\n\n";
        if (!write(sink, out)) return false;
        if (news.over && news.entries.empty()) sink.done();
        return true;
      },
      [&server](bool) { server.leaveStream(); });
}

void sendPictures(WebServer& server, const std::shared_ptr<SessionLink>& link,
                  httplib::Response& response) {
  response.set_content_provider(
      std::string("multipart/x-mixed-replace; boundary=") + kBoundary,
      [&server, link, last = std::uint64_t{0}](std::size_t, httplib::DataSink& sink) mutable {
        if (server.ending()) return false;
        const SessionLink::Picture picture = link->picture(last, kPatience);
        if (!picture.jpeg)
          return sink.is_writable() && !link->wait(0, std::chrono::milliseconds(0)).over;
        last = picture.number;
        return write(sink, std::string("--") + kBoundary +
                               "\r\nContent-Type: image/jpeg\r\nContent-Length: " +
                               std::to_string(picture.jpeg->size()) + "\r\n\r\n" + *picture.jpeg +
                               "\r\n");
      },
      [&server](bool) { server.leaveStream(); });
}

std::shared_ptr<SessionLink> linkFor(WebServer& server, Console& c, const std::string& id,
                                     httplib::Response& response) {
  auto link = c.sessions.link(id);
  if (!link) {
    c.sessions.folder(id);
    response.status =
        204;  // over before this console began: nothing live to tell, and no reason to ask again
    return nullptr;
  }
  if (server.enterStream()) return link;
  refuse(response, 503, "too many pages look on at once: close some");
  return nullptr;
}

}  // namespace

void addLiveRoutes(WebServer& server, Console& c) {
  server.Get(R"(/api/sessions/([A-Za-z0-9_-]{1,64})/live)",
             [&server, &c](const httplib::Request& q, httplib::Response& r) {
               if (const auto link = linkFor(server, c, q.matches[1], r))
                 sendEvents(server, link, wholeNumber(q.get_header_value("Last-Event-ID"), 0), r);
             });
  server.Get(R"(/api/sessions/([A-Za-z0-9_-]{1,64})/view)",
             [&server, &c](const httplib::Request& q, httplib::Response& r) {
               if (const auto link = linkFor(server, c, q.matches[1], r))
                 sendPictures(server, link, r);
             });
  server.Get(R"(/api/sessions/([A-Za-z0-9_-]{1,64})/picture)",
             [&c](const httplib::Request& q, httplib::Response& r) {
               const auto link = c.sessions.link(q.matches[1]);
               const SessionLink::Picture picture =
                   link ? link->picture(0, kPatience) : SessionLink::Picture{};
               if (!picture.jpeg) return refuse(r, 404, "there is no picture yet");
               r.set_content(*picture.jpeg, "image/jpeg");
             });
}

}  // namespace palpa::console
