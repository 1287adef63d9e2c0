#include <cstdio>
#include <memory>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>

#include "anatomy/geometry/error.h"
#include "apps/cli/commands.h"
#include "apps/station/assets.h"
#include "apps/station/station_file.h"
#include "ar/board.h"

namespace palpa::cli {
namespace {

struct BoardOptions {
  std::string station, board, out = "board.png";
  int dpi = 300;
};

/// A bar of 100 mm below the board, so that the print's scale can be checked with a ruler.
void addScaleBar(cv::Mat& page, double px_per_m) {
  const int margin = static_cast<int>(0.015 * px_per_m), bar = static_cast<int>(0.100 * px_per_m);
  cv::copyMakeBorder(page, page, 0, 2 * margin, 0, std::max(0, bar + 2 * margin - page.cols), cv::BORDER_CONSTANT, 255);
  const cv::Point from(margin, page.rows - margin);
  cv::rectangle(page, cv::Rect(from.x, from.y, bar, static_cast<int>(0.002 * px_per_m)), 0, cv::FILLED);
  cv::putText(page, "100 mm: measure before use", from - cv::Point(0, static_cast<int>(0.003 * px_per_m)),
              cv::FONT_HERSHEY_SIMPLEX, px_per_m * 0.00012, 0, std::max(1, static_cast<int>(px_per_m * 0.0003)), cv::LINE_AA);
}

cv::Mat drawn(const BoardOptions& o, double px_per_m) {
  if (!o.board.empty()) return ar::drawBoard(o.board, px_per_m);
  const station::Station station = station::readStation(
      o.station.empty() ? station::assetFile("stations/virtual_bench.json") : std::filesystem::path(o.station));
  return ar::drawTagGrid(station.board, px_per_m);
}

void print(const BoardOptions& o) {
  const double px_per_m = o.dpi / 0.0254;
  cv::Mat page = drawn(o, px_per_m);
  addScaleBar(page, px_per_m);
  bool written = false;
  try {
    written = cv::imwrite(o.out, page);
  } catch (const cv::Exception&) {
  }
  if (!written) throw Error("cannot be written", o.out, "Choose a writable place that ends in .png");
  std::printf("Written: %s (%.0f x %.0f mm at %d dpi; print without scaling, measure the bar)\n", o.out.c_str(),
              1e3 * page.cols / px_per_m, 1e3 * page.rows / px_per_m, o.dpi);
}

}  // namespace

void addBoard(CLI::App& program) {
  CLI::App* board = program.add_subcommand("board", "The board that the camera looks for");
  board->require_subcommand(1);
  CLI::App* command = board->add_subcommand("print", "Draw a board for printing, with a scale bar");
  command->footer("Examples:\n  palpa board print --out board.png --dpi 300\n"
                  "  palpa board print --board charuco:7x5:0.030:0.022 --out charuco.png");
  const auto o = std::make_shared<BoardOptions>();
  CLI::Option* file = command->add_option("--station", o->station, "Station file")->type_name("FILE");
  command->add_option("--board", o->board, "Instead of the station's: tags:, aprilgrid:, chessboard: or charuco:, or a board file")
      ->excludes(file);
  command->add_option("--out", o->out, "PNG to write")->type_name("FILE");
  command->add_option("--dpi", o->dpi, "Dots an inch")->check(CLI::Range(72, 1200));
  command->callback([o] { print(*o); });
}

}  // namespace palpa::cli
