#include "apps/report/plot/map_plot.h"

#include <gtest/gtest.h>

#include <cmath>
#include <opencv2/imgcodecs.hpp>

#include "anatomy/base/error.h"
#include "well_formed.h"

namespace palpa::report {
namespace {

MapValues ramp(int columns, int rows) {  // grows toward +x and, tenfold, toward +y
  MapValues map{columns, rows, 0, 30, -10, 10, {}};
  for (int j = 0; j < rows; ++j)
    for (int i = 0; i < columns; ++i)
      map.values.push_back(static_cast<float>(i) + 10 * static_cast<float>(j));
  return map;
}

std::string colourAt(const cv::Mat& picture, int row, int column) {
  const auto& pixel = picture.at<cv::Vec3b>(row, column);  // blue, green, red
  char text[8];
  std::snprintf(text, sizeof text, "#%02x%02x%02x", pixel[2], pixel[1], pixel[0]);
  return text;
}

TEST(MapColour, IsWhiteAtNothingBlueBelowAndOrangeAbove) {
  EXPECT_EQ(mapColour(0, 2), "#f7f7f7");
  EXPECT_EQ(mapColour(-2, 2), "#08306b");
  EXPECT_EQ(mapColour(2, 2), "#7f2704");
  EXPECT_EQ(mapColour(5, 2), mapColour(2, 2)) << "beyond the end as there";
  EXPECT_EQ(mapColour(std::nan(""), 2), "#808080");
}

/// So that order can be seen without hue, too.
TEST(MapColour, IsDarkerTheFartherFromNothing) {
  const auto luminance = [](double value) {
    unsigned r = 0, g = 0, b = 0;
    EXPECT_EQ(std::sscanf(mapColour(value, 1).c_str(), "#%2x%2x%2x", &r, &g, &b), 3);
    return 0.2126 * r + 0.7152 * g + 0.0722 * b;
  };
  for (const double sign : {-1.0, 1.0})
    for (double x = 0; x < 0.95; x += 0.05)
      EXPECT_GT(luminance(sign * x), luminance(sign * (x + 0.05))) << sign * x;
}

TEST(MapPng, APixelAValueNorthUp) {
  const std::string png = mapPng(ramp(5, 3), 24);
  const cv::Mat picture =
      cv::imdecode(std::vector<unsigned char>(png.begin(), png.end()), cv::IMREAD_COLOR);
  ASSERT_EQ(picture.cols, 5);
  ASSERT_EQ(picture.rows, 3);
  EXPECT_EQ(colourAt(picture, 2, 0), mapColour(0, 24)) << "the first value is at the lower left";
  EXPECT_EQ(colourAt(picture, 2, 4), mapColour(4, 24));
  EXPECT_EQ(colourAt(picture, 0, 0), mapColour(20, 24));
}

TEST(MapPng, WhatIsNoMapIsRefused) {
  MapValues map = ramp(5, 3);
  map.values.pop_back();
  EXPECT_THROW(mapPng(map, 1), Error);
  EXPECT_THROW(mapPng(ramp(5, 3), 0), Error);
  EXPECT_THROW(mapPng({}, 1), Error);
}

TEST(MapPlot, HasAxesBarAndWhatIsDrawnOverItAndStandsAlone) {
  const MapPlot plot{ramp(6, 4), "A <ramp>", "U", "height, U", 0, 35, 35};
  const std::string svg = mapFile(plot, [](Html& over, const Axis& x, const Axis& y) {
    EXPECT_LT(x.at(0), x.at(30));
    EXPECT_GT(y.at(-10), y.at(10)) << "up is up";
    EXPECT_NEAR((x.at(30) - x.at(0)) / 30, (y.at(-10) - y.at(10)) / 20, 1e-9) << "as long each way";
    svgText(over, "on-map", x.at(15), y.at(0), "here");
  });
  EXPECT_EQ(test::faultOf(svg), "");
  for (const char* words :
       {"<style>", "x, U", "y, U", "height, U", ">here<", ">30<", "A &lt;ramp&gt;"})
    EXPECT_NE(svg.find(words), std::string::npos) << words;
  Html page;
  drawMap(page, plot);
  EXPECT_EQ(page.str().find("<style>"), std::string::npos) << "a page has its own";
}

}  // namespace
}  // namespace palpa::report
