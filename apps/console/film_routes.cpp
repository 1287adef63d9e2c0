#include <fstream>
#include <string>
#include <vector>

#include "anatomy/base/error.h"
#include "anatomy/base/film_table.h"
#include "apps/console/routes.h"
#include "apps/record/session_file.h"

namespace palpa::console {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;

constexpr const char* kFilm = "room.mjpeg";
constexpr const char* kTable = "room.mjpeg.csv";
constexpr std::uint64_t kLargest = 1 << 20;  // bytes of a picture

/// Of one trial's pictures [time of the trial in s, where in the film, bytes], in their order.
json picturesOf(const fs::path& folder, int number) {
  json all = json::array();
  std::error_code none;
  const std::uint64_t bytes = fs::file_size(folder / kFilm, none);
  if (none) return all;
  const std::vector<FilmPicture> pictures = filmTable(folder / kFilm);
  const record::SessionReader session(folder / "session.palpa");
  const training::TrialTimes times = record::trialTimes(session)[number];
  for (const record::RecordedTrial& trial : session.trials()) {
    if (trial.header.trial != number) continue;
    for (std::size_t i = 0; i < pictures.size(); ++i) {
      const std::uint64_t to = i + 1 < pictures.size() ? pictures[i + 1].offset : bytes;
      if (pictures[i].t_ns >= trial.header.t_ns && !trial.isOver(pictures[i].t_ns) &&
          pictures[i].offset < to && to <= bytes)
        all.push_back({times.at(pictures[i].t_ns), pictures[i].offset, to - pictures[i].offset});
    }
  }
  return all;
}

/// Of twelve digits at most, as the paths here have them.
std::uint64_t numberIn(const std::string& digits) { return std::stoull(digits); }

/// One picture out of the film; nothing else in the folder can be asked for so.
void sendPicture(httplib::Response& response, const fs::path& film, std::uint64_t offset,
                 std::uint64_t bytes) {
  std::string jpeg(bytes <= kLargest ? bytes : 0, '\0');
  std::ifstream in(film, std::ios::binary);
  in.seekg(static_cast<std::streamoff>(offset));
  const bool read = in.read(jpeg.data(), static_cast<std::streamsize>(jpeg.size())).good();
  if (!read || !jpeg.starts_with("\xff\xd8")) return refuse(response, 404, "is not here");
  response.set_header("Cache-Control", "no-store");
  response.set_content(jpeg, "image/jpeg");
}

/// On somebody's wish; everything else of the session stays.
void forget(httplib::Response& response, const fs::path& folder) {
  for (const char* name : {kFilm, kTable}) {
    std::error_code problem;
    fs::remove(folder / name, problem);
    if (problem)
      throw Error("cannot be removed (" + problem.message() + ")", (folder / name).string(),
                  "Make its folder writable");
  }
  answer(response, json::object());
}

}  // namespace

void addFilmRoutes(WebServer& server, Console& c) {
  server.Get(R"(/api/sessions/([A-Za-z0-9_-]{1,64})/trials/([0-9]{1,5})/room)",
             [&c](const httplib::Request& q, httplib::Response& r) {
               answer(r, picturesOf(c.sessions.shown(q.matches[1]),
                                    static_cast<int>(wholeNumber(q.matches[2], 0))));
             });
  server.Get(R"(/api/sessions/([A-Za-z0-9_-]{1,64})/room/([0-9]{1,12})/([0-9]{1,7}))",
             [&c](const httplib::Request& q, httplib::Response& r) {
               sendPicture(r, c.sessions.shown(q.matches[1]) / kFilm, numberIn(q.matches[2]),
                           numberIn(q.matches[3]));
             });
  server.Post(R"(/api/sessions/([A-Za-z0-9_-]{1,64})/room/delete)",
              [&c](const httplib::Request& q, httplib::Response& r) {
                bodyOf(q);
                forget(r, c.sessions.shown(q.matches[1]));
              });
}

}  // namespace palpa::console
