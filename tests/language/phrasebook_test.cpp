#include "apps/language/phrasebook.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>

#include "anatomy/base/error.h"
#include "apps/language/phrase.h"

namespace palpa::language {
namespace {

/// In capitals, so that it shows what was said.
std::string loud(const std::string& id) {
  std::string out = id;
  std::transform(out.begin(), out.end(), out.begin(),
                 [](char c) { return c >= 'a' && c <= 'z' ? static_cast<char>(c - 32) : c; });
  return out;
}

Phrasebook bookOf(std::initializer_list<const char*> ids) {
  std::vector<PoFile::Message> all;
  for (const char* id : ids) all.push_back({id, loud(id)});
  return Phrasebook(all, {",", "."});
}

TEST(Phrasebook, SaysAMessageAndWhatIsPutIn) {
  const Phrasebook book = bookOf({"{1} mm of {2}", "the left lung", "Trial {1} of {2}"});
  EXPECT_EQ(book.said("3.2 mm of the left lung"), "3,2 MM OF THE LEFT LUNG");
  EXPECT_EQ(book.said("Trial 3 of 5."), "TRIAL 3 OF 5.");
}

TEST(Phrasebook, ChangesTheOrder) {
  const Phrasebook book({{"{1} of {2} trials", "von {2} Versuchen {1}"}}, {",", "."});
  EXPECT_EQ(book.said("3 of 1,250 trials"), "von 1.250 Versuchen 3");
}

TEST(Phrasebook, ReadsSentencesThatWerePutTogether) {
  const Phrasebook book = bookOf({"cannot be read", "Look whether it is there", "Recall {1}",
                                  "precision {1}", "{1} must be {2}", "a number above {1}"});
  EXPECT_EQ(book.said("/tmp/x.json: cannot be read. Look whether it is there"),
            "/tmp/x.json: CANNOT BE READ. LOOK WHETHER IT IS THERE");
  EXPECT_EQ(book.said("Recall 0.44, precision 0.8"), "RECALL 0,44, PRECISION 0,8");
  EXPECT_EQ(book.said("x must be a number above 1,250.5; next"),
            "x MUST BE A NUMBER ABOVE 1.250,5; next");
}

TEST(Phrasebook, TakesTheReadingThatLeavesLeast) {
  const Phrasebook book = bookOf({"{1} of {2}", "out of reach", "{1} is out", "the needle"});
  EXPECT_EQ(book.said("the needle is out of reach"), "THE NEEDLE is OUT OF REACH");
}

TEST(Phrasebook, KeepsTheCaseOfAFirstLetter) {
  const Phrasebook book({{"the left lung", "ο αριστερός πνεύμονας"}}, {",", "."});
  EXPECT_EQ(book.said("The left lung"), "Ο αριστερός πνεύμονας");
}

TEST(Phrasebook, LeavesWhatIsTypedAlone) {
  const Phrasebook book = bookOf({"{1} is given more than once", "See: {1} --help", "study",
                                  "trainee", "report", "the trainee"});
  EXPECT_EQ(
      book.said("--leave-out-study ID is given more than once. See: palpa report trainee --help"),
      "--leave-out-study ID IS GIVEN MORE THAN ONCE. SEE: palpa report trainee --HELP");
  EXPECT_EQ(book.said("palpa: the trainee"), "palpa: THE TRAINEE");
}

TEST(Phrasebook, KeepsColumnsWhereTheyBegin) {
  const Phrasebook book({{"well", "in Ordnung"}, {"ill", "불량"}, {"camera", "cam"}}, {",", "."});
  EXPECT_EQ(book.said("well   camera     /dev/video0\nill    camera     none"),
            "in Ordnung  cam   /dev/video0\n불량   cam        none");
  EXPECT_EQ(book.said("  well"), "  in Ordnung");
}

TEST(Phrasebook, LeavesNamesPathsAndOptionsAlone) {
  const Phrasebook book = bookOf({"passes", "replay", "main", "fast"});
  for (const char* text :
       {"/home/passes/a", "passes.json", "--fast", "a_main", "mainly", "replay/1", "x@main.org"})
    EXPECT_EQ(book.said(text), text);
  EXPECT_EQ(book.said("two passes, fast"), "two PASSES, FAST");
}

TEST(Phrasebook, LeavesOutAPluralsEnding) {
  const Phrasebook book({{"{1} trial{2} left", "noch {1} Versuche"}}, {",", "."});
  EXPECT_EQ(book.said("3 trials left"), "noch 3 Versuche");
  EXPECT_EQ(book.said("1 trial left"), "noch 1 Versuche");
}

TEST(Phrasebook, KeepsLinesAndColumns) {
  const Phrasebook book = bookOf({"Options", "print help"});
  EXPECT_EQ(book.said("Options:\n  -h,--help    print help\n"),
            "OPTIONS:\n  -h,--help    PRINT HELP\n");
}

TEST(Phrasebook, EnglishStaysAsItIs) {
  EXPECT_EQ(Phrasebook().said("1,250.5 mm of anything"), "1,250.5 mm of anything");
  EXPECT_TRUE(Phrasebook().isEnglish());
}

TEST(Phrasebook, RefusesAPlaceThatTheMessageDoesNotHave) {
  EXPECT_THROW(Phrasebook({{"{1} mm", "{2} mm"}}, {}), UsageError);
}

/// Whatever is read, it ends, and nothing but what has a message is changed.
TEST(Phrasebook, EndsOnWhateverIsRead) {
  const Phrasebook book = bookOf({"{1} of {2}", "{1} a {2} a {3}", "a {1}", "{1}a", "a{1}"});
  std::mt19937 random(7);
  for (int i = 0; i < 200; ++i) {
    std::string text;
    for (int n = 0; n < 300; ++n) text += "a aof. ,;:()"[random() % 12];
    EXPECT_GE(book.said(text).size(), text.size() / 2);
  }
}

TEST(NumberForm, WritesOnlyNumbersThatStandAlone) {
  const NumberForm german{",", "."};
  EXPECT_EQ(numbersIn("1,250.5 mm, 0.3. Then 2,5", german), "1.250,5 mm, 0,3. Then 2,5");
  for (const char* text : {"1.2.3", "127.0.0.1:80", "v1.5", "a/1.5/b", "x1.5", "1.5mm_a", "1,2,3"})
    EXPECT_EQ(numbersIn(text, german), text);
  EXPECT_EQ(numbersIn("12,500,000", {",", "\u202f"}), "12\u202f500\u202f000");
}

}  // namespace
}  // namespace palpa::language
