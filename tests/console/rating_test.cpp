#include "served.h"
#include "tests/support/files.h"

namespace palpa::console {
namespace {

/// What a rater marks is kept beside the session, as the command reads it; nothing else is taken.
TEST(Rating, ARatersMarksAreKept) {
  Desk desk("rated");
  Served& console = *desk.console;
  const json forms = console.get("/api/forms");
  ASSERT_EQ(forms["checklist"]["items"].size(), 7u) << forms.dump();
  ASSERT_EQ(forms["global"]["items"].size(), 6u);
  EXPECT_EQ(forms.dump().find("rules"), std::string::npos) << "the simulator's rules stay its own";
  const std::string id = desk.begin(), path = "/api/sessions/" + id + "/ratings/1";
  EXPECT_EQ(console.get(path)["values"], json::object());
  const json marks{{"sterile", "done"}, {"explained", "not done"}, {"plan", 4}};
  json told;
  EXPECT_EQ(console.post(path, {{"rater", "R1"}, {"values", marks}}, &told), 200) << told.dump();
  EXPECT_EQ(told["values"], marks);
  desk.restart();
  const json kept = desk.console->get(path);
  EXPECT_EQ(kept["values"], marks);
  EXPECT_EQ(kept["rater"], "R1");
  const std::string sheet = test::slurp(desk.folder / "home" / "sessions" / id / "rating-1.csv");
  EXPECT_NE(sheet.find("\nitem,value\n"), std::string::npos) << sheet;
  EXPECT_NE(sheet.find("\nsterile,done\n"), std::string::npos) << sheet;
  EXPECT_NE(sheet.find("\nplan,4\n"), std::string::npos) << sheet;
  for (const json& wrong :
       {json{{"rater", "Dr Smith"}, {"values", marks}}, json{{"values", marks}},
        json{{"rater", "R1"}, {"values", {{"sterile", "perhaps"}}}},
        json{{"rater", "R1"}, {"values", {{"plan", 6}}}},
        json{{"rater", "R1"}, {"values", {{"point", "done"}}}},  // the simulator's
        json{{"rater", "R1"}, {"values", {{"x\n,y", "done"}}}},
        json{{"rater", "R1"}, {"values", json::array({1})}}})
    EXPECT_EQ(desk.console->post(path, wrong), 422) << wrong.dump();
  EXPECT_EQ(desk.console->post("/api/sessions/" + id + "/ratings/0",
                               {{"rater", "R1"}, {"values", marks}}),
            422);
  EXPECT_EQ(desk.console->get(path)["values"], marks);
  desk.console->post("/api/sessions/" + id + "/command", {{"command", "leave"}});
}

}  // namespace
}  // namespace palpa::console
