#include "apps/report/pictures.h"

#include <fstream>
#include <iterator>
#include <string>

#include "apps/report/base64.h"
#include "apps/report/numbers.h"

namespace palpa::report {
namespace {

/// The file's bytes if it is a PNG, else "".
std::string readPng(const std::filesystem::path& file) {
  std::ifstream stream(file, std::ios::binary);
  std::string bytes{std::istreambuf_iterator<char>(stream), {}};
  return bytes.starts_with("\x89PNG\r\n\x1a\n") ? bytes : "";
}

void writeOne(Html& html, const Picture& picture) {
  const auto figure = html.in("figure", {{"class", "picture"}});
  const std::string bytes = readPng(picture.file);
  if (bytes.empty()) {
    html.element("p", {{"class", "missing"}},
                 "The picture " + picture.file.filename().string() + " could not be read.");
  } else {
    html.empty("img",
               {{"src", "data:image/png;base64," + base64(bytes)}, {"alt", picture.caption}});
  }
  const auto caption = html.in("figcaption");
  if (picture.t_s >= 0) html.element("span", {{"class", "time"}}, fixed(picture.t_s, 1) + " s");
  html.text(picture.caption);
}

}  // namespace

void writePictures(Html& html, const std::vector<Picture>& pictures) {
  if (pictures.empty()) return;
  html.element("h3", "Pictures");
  const auto grid = html.in("div", {{"class", "pictures"}});
  for (const Picture& picture : pictures) writeOne(html, picture);
}

}  // namespace palpa::report
