#include "apps/report/page/pictures.h"

#include <algorithm>
#include <array>

#include "anatomy/base/text_forms.h"
#include "anatomy/base/whole_file.h"
#include "apps/report/page/page_parts.h"
#include "apps/report/page/small_picture.h"

namespace palpa::report {
namespace {

/// px. Three stand side by side on a desktop, 320 px each; a screen with two pixels for one shows
/// twice that.
constexpr std::array kWidths{640, 480, 360, 240};
constexpr std::size_t kShare = 4;

/// As its page carries it, Base64; "": the file is no picture.
using Coded = std::vector<std::string>;

std::size_t bytesOf(const Coded& all) {
  std::size_t bytes = 0;
  for (const std::string& one : all) bytes += one.size();
  return bytes;
}

/// The largest that fit into so many bytes; nothing where none do.
Coded codedWithin(std::size_t most, const std::vector<SmallPicture>& pictures) {
  for (const int wide : kWidths) {
    Coded coded;
    for (const SmallPicture& picture : pictures)
      coded.push_back(picture.isThere() ? base64(picture.webp(wide)) : "");
    if (bytesOf(coded) <= most) return coded;
  }
  return {};
}

void writeOne(Html& html, const Picture& picture, bool readable, const std::string& coded) {
  const auto figure = html.in("figure", {{"class", "picture"}});
  const std::string name = picture.file.filename().string();
  if (!readable)
    html.element("p", {{"class", "missing"}}, "The picture " + name + " could not be read.");
  else if (coded.empty())
    html.empty("img", {{"src", name}, {"alt", picture.caption}, {"loading", "lazy"}});
  else
    html.empty("img", {{"src", "data:image/webp;base64," + coded}, {"alt", picture.caption}});
  const auto caption = html.in("figcaption");
  if (picture.t_s >= 0) html.element("span", {{"class", "time"}}, fixed(picture.t_s, 1) + " s");
  html.text(picture.caption);
}

}  // namespace

void writePictures(Html& html, const std::vector<Picture>& pictures, std::size_t carried) {
  if (pictures.empty()) return;
  std::vector<SmallPicture> read;
  for (const Picture& picture : pictures) read.emplace_back(readWhole(picture.file).value_or(""));
  const std::size_t left = carried - std::min(carried, html.pictureBytes());
  const Coded coded = codedWithin(left / kShare, read);
  html.countPicture(bytesOf(coded));
  html.element("h3", "Pictures");
  if (coded.empty())
    html.element("p", {{"class", "muted small"}},
                 "So that this page can be mailed, these pictures are in the files beside it. Open "
                 "it in the session's folder to see them.");
  const auto grid = html.in("div", {{"class", "pictures"}});
  for (std::size_t i = 0; i < pictures.size(); ++i)
    writeOne(html, pictures[i], read[i].isThere(), coded.empty() ? "" : coded[i]);
  html.passOn();
}

}  // namespace palpa::report
