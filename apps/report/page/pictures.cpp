#include "apps/report/page/pictures.h"

#include <algorithm>
#include <array>

#include "anatomy/base/error.h"
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

/// "": it could not be coded, as one that cannot be read.
std::string codedAs(const SmallPicture& picture, int wide) {
  try {
    return picture.isThere() ? base64(picture.webp(wide)) : "";
  } catch (const Error&) {
    return "";
  }
}

/// The largest that fit into so many bytes; nothing where none do.
Coded codedWithin(std::size_t most, const std::vector<SmallPicture>& pictures) {
  constexpr std::size_t kLeast = 1500;  // one of them cannot be smaller, and be seen
  if (most < kLeast * pictures.size()) return {};
  for (const int wide : kWidths) {
    Coded coded;
    for (const SmallPicture& picture : pictures) coded.push_back(codedAs(picture, wide));
    if (bytesOf(coded) <= most) return coded;
  }
  return {};
}

void writeCaption(Html& html, const Picture& picture) {
  const auto caption = html.in("figcaption");
  if (picture.t_s >= 0) html.element("span", {{"class", "time"}}, fixed(picture.t_s, 1) + " s");
  html.text(picture.caption);
}

void writeOne(Html& html, const Picture& picture, const std::string& coded) {
  const auto figure = html.in("figure", {{"class", "picture"}});
  if (coded.empty())
    html.element("p", {{"class", "missing"}},
                 "The picture " + picture.file.filename().string() + " could not be read.");
  else
    html.empty("img", {{"src", "data:image/webp;base64," + coded}, {"alt", picture.caption}});
  writeCaption(html, picture);
}

/// Which files beside the page show what.
void writeNames(Html& html, const std::vector<Picture>& pictures) {
  html.element("p", {{"class", "muted small"}},
               "So that this page can be mailed, these are not in it. They are files in the "
               "session's folder; the console shows them with the session's result.");
  const auto list = html.in("ul", {{"class", "picture-names"}});
  for (const Picture& picture : pictures) {
    const auto item = html.in("li");
    html.element("code", picture.file.filename().string());
    html.raw(" ");
    if (picture.t_s >= 0) html.text(fixed(picture.t_s, 1) + " s, ");
    html.text(picture.caption);
  }
}

}  // namespace

void writePictures(Html& html, const std::vector<Picture>& pictures, PicturesOf whose) {
  if (pictures.empty()) return;
  std::vector<SmallPicture> read;
  for (const Picture& picture : pictures) read.emplace_back(readWhole(picture.file).value_or(""));
  const std::size_t left = kCarried - std::min(kCarried, html.pictureBytes());
  const Coded coded = codedWithin(whose == PicturesOf::trial ? left / kShare : left, read);
  html.countPicture(bytesOf(coded));
  html.element("h3", "Pictures");
  if (coded.empty()) return writeNames(html, pictures);
  const auto grid = html.in("div", {{"class", "pictures"}});
  for (std::size_t i = 0; i < pictures.size(); ++i) writeOne(html, pictures[i], coded[i]);
  html.passOn();
}

}  // namespace palpa::report
