#include <gtest/gtest.h>

#include <algorithm>
#include <regex>
#include <set>

#include "markdown.h"
#include "picture.h"
#include "tree.h"

namespace palpa::guide {
namespace {

namespace fs = std::filesystem;

const fs::path kPictures = top() / "assets/pictures/guide";
constexpr std::uintmax_t kMostBytes = 200'000, kMostInAll = 1'500'000;

bool isElsewhere(const std::string& target) {
  return target.starts_with("http:") || target.starts_with("https:") ||
         target.starts_with("mailto:");
}

/// Empty: the link leads somewhere.
std::string whereWrong(const Link& link, const Page& page) {
  const std::size_t hash = link.target.find('#');
  const std::string path = link.target.substr(0, hash);
  const fs::path file = path.empty() ? page.file : page.file.parent_path() / path;
  if (!fs::exists(file)) return "leads nowhere";
  if (hash == std::string::npos || file.extension() != ".md") return "";
  const std::vector<std::string> anchors = readPage(file).anchors;
  return std::count(anchors.begin(), anchors.end(), link.target.substr(hash + 1))
             ? ""
             : "names no heading there";
}

TEST(Documents, LinksLeadSomewhere) {
  int looked = 0;
  for (const fs::path& file : pagesOfTheProject()) {
    const Page page = readPage(file);
    for (const Link& link : page.links) {
      if (isElsewhere(link.target)) continue;
      ++looked;
      EXPECT_EQ(whereWrong(link, page), "") << file << ":" << link.line << ": " << link.target;
    }
  }
  EXPECT_GE(looked, 30);
}

TEST(Documents, AChapterIsReachedFromTheIndex) {
  std::set<fs::path> named;
  for (const Link& link : readPage(top() / "docs/README.md").links)
    named.insert(
        fs::weakly_canonical(top() / "docs" / link.target.substr(0, link.target.find('#'))));
  for (const fs::path& chapter : chapters())
    EXPECT_TRUE(chapter.filename() == "README.md" || named.contains(fs::weakly_canonical(chapter)))
        << chapter << " is not in docs/README.md";
  const Page readme = readPage(top() / "README.md");
  EXPECT_TRUE(std::any_of(readme.links.begin(), readme.links.end(), [](const Link& link) {
    return link.target.starts_with("docs/");
  })) << "README.md does not name docs/";
}

TEST(Documents, PicturesOfTheGuideAreShownAndSmall) {
  std::set<std::string> shown;
  for (const fs::path& file : chapters())
    for (const Link& link : readPage(file).links)
      if (link.is_picture) shown.insert(fs::path(link.target).filename().string());
  std::uintmax_t all = 0;
  for (const auto& entry : fs::directory_iterator(kPictures)) {
    all += entry.file_size();
    EXPECT_TRUE(shown.contains(entry.path().filename().string()))
        << entry.path() << " is shown nowhere";
    EXPECT_LE(entry.file_size(), kMostBytes) << entry.path();
    EXPECT_GT(sizeOf(entry.path()).width, 100) << entry.path();
  }
  EXPECT_LE(all, kMostInAll);
}

// A drawing says where things are: below its boxes stand folders.
TEST(Documents, FoldersInADrawingExist) {
  const std::string drawing = bytesOf(kPictures / "data-flow.svg");
  const std::regex folder("<text class=\"folder\"[^>]*>([^<]+)<");
  int looked = 0;
  for (std::sregex_iterator it(drawing.begin(), drawing.end(), folder), end; it != end; ++it) {
    ++looked;
    EXPECT_TRUE(fs::is_directory(top() / (*it)[1].str())) << (*it)[1] << " is no folder";
  }
  EXPECT_GE(looked, 20);
}

TEST(Documents, ChaptersAreShort) {
  for (const fs::path& file : chapters())
    EXPECT_LE(fs::file_size(file), 12'000u) << file << ": more than some three pages";
}

}  // namespace
}  // namespace palpa::guide
