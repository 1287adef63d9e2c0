#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <string>

#include <nlohmann/json.hpp>
#include <opencv2/core.hpp>

#include "anatomy/base/error.h"
#include "apps/runtime/recorders.h"
#include "apps/session/session_records.h"
#include "tests/session/quick_sessions.h"

/// Who is filmed, and that nobody is unasked.
namespace palpa::session {
namespace {

/// A film of ten pictures, as a room's camera would give.
std::filesystem::path someFilm(const std::filesystem::path& folder) {
  runtime::PictureFile film(folder, "given", "offset");
  for (int i = 0; i < 10; ++i)
    film.add(cv::Mat(48, 64, CV_8UC3, cv::Scalar::all(20 * i)), i * 125'000'000LL, 90, "0");
  return folder / "given.mjpeg";
}

std::string refusal(const SessionOptions& asked, void (*by)(SessionOptions&)) {
  SessionOptions options = asked;
  try {
    by(options);
  } catch (const UsageError& e) {
    return e.what();
  }
  return "";
}

bool says(const std::string& text, const std::string& words) {
  return text.find(words) != std::string::npos;
}

TEST(Filmed, NobodyIsUnasked) {
  SessionOptions options = quick(OperatorKind::expert);
  options.film_room = someFilm(freshPlace("unasked"));
  EXPECT_TRUE(says(refusal(options, settle), "nobody has said that they agree"));
  options.film_agreed = true;
  EXPECT_EQ(refusal(options, settle), "");
  options.film_room = "/nowhere/film.mjpeg";
  EXPECT_TRUE(says(refusal(options, settle), "is not there"));
  options.film_room = "/dev/null";  // no film: a device
  EXPECT_TRUE(says(refusal(options, settle), "needs real time"));
}

TEST(Filmed, AFilmIsOfSomebodyInTheRecords) {
  SessionOptions options = quick(OperatorKind::person);
  options.film_room = someFilm(freshPlace("whose"));
  options.film_agreed = true;
  EXPECT_TRUE(says(refusal(options, checkTrainee), "that person's records"));
  options.who = OperatorKind::expert;
  EXPECT_EQ(refusal(options, checkTrainee), "") << "no person performs";
}

TEST(Filmed, TheFilmStandsBesideTheEvidenceWhichSaysSo) {
  SessionOptions options = quick(OperatorKind::expert, 3);
  NeedleWorld world(options);
  world.station.camera_rate_Hz = 1;
  const std::filesystem::path folder = freshPlace("filmed");
  options.film_room = someFilm(folder);
  options.film_agreed = true;
  const SessionResult result = runNeedleSession(options, world, folder);
  std::ifstream table(folder / "room.mjpeg.csv");
  std::string line;
  int lines = 0;
  while (std::getline(table, line)) ++lines;
  EXPECT_EQ(lines, 11) << "its head and each picture";
  EXPECT_GT(std::filesystem::file_size(folder / "room.mjpeg"), 1000u);
  const record::SessionReader session(folder / "session.palpa");
  EXPECT_EQ(nlohmann::json::parse(session.info().session_json).at("filmed"), true);
  const auto told = std::find_if(result.devices.begin(), result.devices.end(),
                                 [](const auto& fact) { return fact.name == "Film of the room"; });
  ASSERT_NE(told, result.devices.end());
  EXPECT_EQ(told->value, "10 pictures");
}

}  // namespace
}  // namespace palpa::session
