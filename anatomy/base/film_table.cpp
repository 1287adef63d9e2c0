#include "anatomy/base/film_table.h"

#include <charconv>
#include <fstream>
#include <string>

namespace palpa {
namespace {

/// The number after the comma at `*comma`, whose place becomes the next comma's; false: there is
/// none.
template <class Number>
bool readNext(const std::string& line, std::size_t* comma, Number* number) {
  if (*comma == std::string::npos) return false;
  const char* const end = line.data() + line.size();
  const std::size_t digits = line.find_first_not_of(' ', *comma + 1);
  if (digits == std::string::npos) return false;
  const auto [stop, problem] = std::from_chars(line.data() + digits, end, *number);
  *comma = line.find(',', *comma + 1);
  return problem == std::errc() && (stop == end || *stop == ',' || *stop == '\r');
}

}  // namespace

std::vector<FilmPicture> filmTable(const std::filesystem::path& film) {
  std::vector<FilmPicture> pictures;
  std::ifstream table(film.string() + ".csv");
  std::string line;
  std::getline(table, line);
  const bool has_offset = line.find(",offset") != std::string::npos;
  while (std::getline(table, line)) {
    FilmPicture picture;
    std::size_t comma = line.find(',');
    if (!readNext(line, &comma, &picture.t_ns) ||
        (has_offset && !readNext(line, &comma, &picture.offset)))
      break;
    pictures.push_back(picture);
  }
  return pictures;
}

}  // namespace palpa
