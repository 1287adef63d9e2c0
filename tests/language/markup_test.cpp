#include "apps/language/markup.h"

#include <gtest/gtest.h>

namespace palpa::language {
namespace {

Spoken spokenLoud(bool from_right = false) {
  Spoken one;
  one.code = "xx";
  one.from_right = from_right;
  one.book = Phrasebook({{"Depth", "TIEFE"}, {"the \"left\" lung & more", "<LUNGE>"}}, {",", "."});
  return one;
}

TEST(PageSpeaker, SaysTextsAndAttributes) {
  EXPECT_EQ(
      pageIn("<html lang=\"en\"><p title=\"Depth\" class=\"Depth\">Depth 1.5</p>", spokenLoud()),
      "<html lang=\"xx\"><p title=\"TIEFE\" class=\"Depth\">TIEFE 1,5</p>");
  EXPECT_EQ(pageIn("<p>the &quot;left&quot; lung &amp; more</p>", spokenLoud()),
            "<p>&lt;LUNGE&gt;</p>");
}

TEST(PageSpeaker, LeavesWhatWasTypedStylesAndScripts) {
  const std::string page =
      "<style>.Depth{}</style><script>Depth</script><!-- Depth -->"
      "<p translate=\"no\">Depth <b>Depth</b><br/>Depth</p><p>Depth</p>";
  EXPECT_EQ(pageIn(page, spokenLoud()),
            "<style>.Depth{}</style><script>Depth</script><!-- Depth -->"
            "<p translate=\"no\">Depth <b>Depth</b><br/>Depth</p><p>TIEFE</p>");
}

TEST(PageSpeaker, MayBeCutBetweenElements) {
  const Spoken language = spokenLoud(true);
  PageSpeaker speaker(language);
  EXPECT_EQ(speaker.more("<html><p translate=\"no\">"),
            "<html lang=\"xx\" dir=\"rtl\"><p translate=\"no\">");
  EXPECT_EQ(speaker.more("Depth</p><p>"), "Depth</p><p>");
  EXPECT_EQ(speaker.more("Depth</p>"), "TIEFE</p>");
}

TEST(PageSpeaker, EndsOnDamagedPages) {
  for (const char* page : {"<", "<p", "<p title=\"", "<!--", "</p></p>Depth", "<style>", "<>", "&"})
    pageIn(page, spokenLoud());
}

}  // namespace
}  // namespace palpa::language
