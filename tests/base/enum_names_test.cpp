#include "anatomy/base/enum_names.h"

#include <gtest/gtest.h>

#include "anatomy/base/error.h"

namespace palpa {
namespace {

enum class Colour { red, green };

const EnumNames<Colour> kColours{"red", "bright green"};

JsonFile paint(const char* colour) {
  return {nlohmann::json::object({{"colour", colour}}), "a paint"};
}

std::string refusal(const char* colour) {
  try {
    kColours.in(paint(colour), "colour");
  } catch (const UsageError& e) {
    return e.what();
  }
  return "";
}

TEST(EnumNames, RoundTrip) {
  for (const Colour colour : {Colour::red, Colour::green})
    EXPECT_EQ(kColours.named(kColours.of(colour)), colour);
  EXPECT_FALSE(kColours.named("green"));
  EXPECT_FALSE(kColours.named(""));
}

TEST(EnumNames, AFileHoldsOneOfThem) {
  EXPECT_EQ(kColours.in(paint("bright green"), "colour"), Colour::green);
  EXPECT_NE(refusal("blue").find("is \"blue\"; known: red, bright green"), std::string::npos)
      << refusal("blue");
}

}  // namespace
}  // namespace palpa
