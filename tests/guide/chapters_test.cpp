#include <gtest/gtest.h>

#include <cctype>
#include <cstdlib>
#include <fstream>

#include "chapter.h"
#include "picture.h"
#include "shell.h"
#include "tests/support/scratch_folder.h"
#include "tree.h"

namespace palpa::guide {
namespace {

namespace fs = std::filesystem;

std::string nameOf(const testing::TestParamInfo<fs::path>& info) {
  std::string name = info.param.stem().string();
  for (char& c : name)
    if (!std::isalnum(static_cast<unsigned char>(c))) c = '_';
  return name;
}

/// Empty: nothing of that name below.
fs::path found(const fs::path& folder, const fs::path& name) {
  for (const auto& entry : fs::recursive_directory_iterator(folder))
    if (entry.is_regular_file() && entry.path().filename() == name) return entry.path();
  return {};
}

/// A drawing byte by byte; a picture by its size, because fonts and drivers differ.
bool isSame(const fs::path& made, const fs::path& kept) {
  return kept.extension() == ".svg" ? bytesOf(made) == bytesOf(kept) : sizeOf(made) == sizeOf(kept);
}

class Chapter : public testing::TestWithParam<fs::path> {
 protected:
  const Page page = readPage(GetParam());
  const test::ScratchFolder folder{"guide-" + GetParam().stem().string()};

  /// The line of the command that makes it; 0: none says its name.
  int makerOf(const std::string& picture) const {
    for (const Command& command : commandsOf(page))
      if (command.text.find(picture) != std::string::npos) return command.line;
    return 0;
  }

  /// Of two programs, of which the older one is not here: a script names it, and it is there.
  void expectNamedByScript(const fs::path& kept) const {
    const std::string script = bytesOf(kept.parent_path().parent_path() / "before_after.sh");
    EXPECT_TRUE(script.find("pair " + kept.stem().string() + " ") != std::string::npos ||
                script.find("/" + kept.filename().string()) != std::string::npos)
        << kept << " is not made by before_after.sh";
    EXPECT_TRUE(fs::is_regular_file(kept)) << kept;
  }

  void expectMade(const Link& link, const std::set<int>& skipped) {
    const fs::path kept = page.file.parent_path() / link.target;
    if (kept.parent_path().filename() == "before_after") return expectNamedByScript(kept);
    const int maker = makerOf(kept.filename().string());
    ASSERT_NE(maker, 0) << "line " << link.line << ": no command of this chapter makes "
                        << kept.filename();
    if (skipped.contains(maker)) return;
    const fs::path made = found(folder / "here", kept.filename());
    ASSERT_FALSE(made.empty()) << "line " << maker << " left no " << kept.filename();
    if (const char* keep = std::getenv("PALPA_GUIDE_PICTURES"))
      fs::copy_file(made, fs::path(keep) / made.filename(), fs::copy_options::overwrite_existing);
    else
      EXPECT_TRUE(isSame(made, kept))
          << kept << " is not what line " << maker << " makes: assets/pictures/guide.sh";
  }
};

// Every command of a chapter, in order, in a folder of its own: exit codes as the chapter says,
// pictures as it shows.
TEST_P(Chapter, DoesWhatItSays) {
  std::ofstream(folder / "script") << scriptOf(page, folder.path());
  ASSERT_EQ(run("bash '" + (folder / "script").string() + "'"), 0);
  const std::set<int> skipped = skippedIn(page, folder.path());
  for (const Link& link : page.links)
    if (link.is_picture) expectMade(link, skipped);
}

/// What the script of a page with these commands exits with.
int codeOf(const std::string& commands) {
  const test::ScratchFolder folder("guide-planted");
  Page page;
  page.blocks.push_back({"sh", "", commands, 1});
  std::ofstream(folder / "script") << scriptOf(page, folder.path());
  return run("bash '" + (folder / "script").string() + "'");
}

TEST(PlantedChapter, FailsWhereACommandDoesNotDoWhatThePageSays) {
  EXPECT_EQ(
      codeOf(
          "export A=1\ntest \"$A\" = 1\nfalse   # exits with 1: as it should\npalpa --version\n"),
      0);
  EXPECT_NE(codeOf("false\ntrue\n"), 0);
  EXPECT_NE(codeOf("true # exits with 1\n"), 0);
  EXPECT_NE(codeOf("palpa doctor --no-such-option\n"), 0);
  EXPECT_NE(codeOf("palpa console --no-open --port nothing\n"), 0);
}

TEST(PlantedChapter, SlowBlocksAreNamedAsSkipped) {
  const test::ScratchFolder folder("guide-planted");
  Page page;
  page.blocks = {{"sh", "slow", "false\n", 7}, {"sh", "", "true\n", 12}};
  EXPECT_EQ(skippedIn(page, folder.path()), everything() ? std::set<int>{} : std::set<int>{7});
  EXPECT_EQ(scriptOf(page, folder.path()).find("command_of 7 ") == std::string::npos,
            !everything());
}

INSTANTIATE_TEST_SUITE_P(Guide, Chapter, testing::ValuesIn(chapters()), nameOf);

}  // namespace
}  // namespace palpa::guide
