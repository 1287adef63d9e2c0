#include "apps/language/po_file.h"

#include <gtest/gtest.h>

#include "anatomy/base/error.h"
#include "tests/support/mutations.h"

namespace palpa::language {
namespace {

constexpr char kSmall[] = R"(# of somebody
msgid ""
msgstr ""
"Language: el\n"
"X-Decimal-Mark: ,\n"

#: apps/a.cpp
msgid "Trial {1}"
msgstr ""
"Δοκιμή "
"{1}"

#, fuzzy
msgid "a \"guess\""
msgstr "x"
)";

TEST(PoFiles, AreRead) {
  const PoFile po = readPo(kSmall, "x.po");
  EXPECT_EQ(po.header.at("Language"), "el");
  EXPECT_EQ(po.header.at("X-Decimal-Mark"), ",");
  ASSERT_EQ(po.messages.size(), 2u);
  EXPECT_EQ(po.messages[0].translation, "Δοκιμή {1}");
  EXPECT_EQ(po.messages[1].id, "a \"guess\"");
  EXPECT_EQ(po.messages[1].translation, "");  // a guess of a tool is no translation
}

TEST(PoFiles, SayWhereTheyAreWrong) {
  for (const char* text :
       {"msgid \"a\nmsgstr \"\"\n", "msgstr \"a\"\n", "msgid \"a\"\nmsgctxt \"b\"\n",
        "msgid \"\\q\"\n", "msgid \"a\\\"\n", "msgid_plural \"a\"\n"})
    EXPECT_THROW(readPo(text, "x.po"), UsageError) << text;
}

}  // namespace
}  // namespace palpa::language
