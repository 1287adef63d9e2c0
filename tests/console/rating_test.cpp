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
  const std::string id = desk.begin(), path = "/api/sessions/" + id + "/ratings/1/R1";
  EXPECT_EQ(console.get(path)["values"], json::object());
  const json marks{{"sterile", "done"}, {"explained", "not done"}, {"plan", 4}};
  json told;
  EXPECT_EQ(console.post(path, {{"values", marks}}, &told), 200) << told.dump();
  EXPECT_EQ(told["values"], marks);
  desk.restart();
  const json kept = desk.console->get(path);
  EXPECT_EQ(kept["values"], marks);
  EXPECT_EQ(kept["rater"], "R1");
  const std::string sheet = test::slurp(desk.folder / "home" / "sessions" / id / "rating-1-R1.csv");
  EXPECT_NE(sheet.find("\nitem,value\n"), std::string::npos) << sheet;
  EXPECT_NE(sheet.find("\nsterile,done\n"), std::string::npos) << sheet;
  EXPECT_NE(sheet.find("\nplan,4\n"), std::string::npos) << sheet;
  for (const json& wrong :
       {json{{"values", {{"sterile", "perhaps"}}}}, json{{"values", {{"plan", 6}}}},
        json{{"values", {{"point", "done"}}}},  // the simulator's
        json{{"values", {{"x\n,y", "done"}}}}, json{{"values", json::array({1})}}})
    EXPECT_EQ(desk.console->post(path, wrong), 422) << wrong.dump();
  const std::string trials = "/api/sessions/" + id + "/ratings/";
  EXPECT_EQ(desk.console->post(trials + "0/R1", {{"values", marks}}), 422);
  EXPECT_EQ(desk.console->post(trials + "1/Dr%20Smith", {{"values", marks}}), 404);
  EXPECT_EQ(desk.console->get(path)["values"], marks);
  // Another rater has a sheet of his own; what was made of the one before goes with its marks.
  EXPECT_EQ(desk.console->get(trials + "1/R2")["values"], json::object());
  const std::filesystem::path folder = desk.folder / "home" / "sessions" / id,
                              page = folder / "exam-1-R1.html",
                              pass = folder / "certificate-1-R1.pdf",
                              others = folder / "certificate-1-R2.pdf";
  for (const auto& made : {page, pass, others}) std::ofstream(made) << "made";
  EXPECT_EQ(desk.console->post(path, {{"values", marks}}), 200);
  EXPECT_TRUE(std::filesystem::exists(pass)) << "the same marks";
  EXPECT_EQ(desk.console->post(path, {{"values", {{"plan", 2}}}}), 200);
  EXPECT_FALSE(std::filesystem::exists(page) || std::filesystem::exists(pass));
  EXPECT_TRUE(std::filesystem::exists(others));
  desk.console->post("/api/sessions/" + id + "/command", {{"command", "leave"}});
}

}  // namespace
}  // namespace palpa::console
