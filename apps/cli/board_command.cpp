#include <cstdio>
#include <memory>

#include "apps/cli/commands.h"
#include "apps/cli/values.h"
#include "apps/report/paper/board_page.h"
#include "apps/station/assets.h"
#include "apps/station/station_file.h"

namespace palpa::cli {
namespace {

struct BoardOptions {
  std::string station, board, out = "board.pdf";
  report::BoardPage page;
};

void print(BoardOptions o) {
  ar::Sheet sheet;
  if (o.board.empty()) {
    const station::Station station =
        station::readStation(o.station.empty() ? station::assetFile("stations/virtual_bench.json")
                                               : std::filesystem::path(o.station));
    sheet = ar::sheetOf(station.board);
    o.page.words =
        "Palpa: board of " + station.title + ", " + ar::makeBoard(station.board)->describe();
  } else {
    sheet = ar::sheetOf(o.board);
    o.page.words = "Palpa: " + ar::makeBoard(o.board)->describe();
  }
  const report::PageSize size = report::writeBoardPage(sheet, o.page, o.out);
  std::printf("Written: %s (%.0f x %.0f mm; print at 100 %%, measure the bars of 100 mm)\n",
              o.out.c_str(), size.width_mm, size.height_mm);
}

}  // namespace

void addBoard(CLI::App& program) {
  CLI::App* board = program.add_subcommand("board", "The board that the camera looks for");
  board->require_subcommand(1);
  board->footer("Example:\n  palpa board print --out board.pdf");
  CLI::App* command = board->add_subcommand(
      "print", "A board to print at its true size, with bars to check the print");
  command->footer(
      "Examples:\n  palpa board print                       the station's board, as board.pdf\n"
      "  palpa board print --board charuco:7x5:0.030:0.022 --out charuco.pdf\n"
      "  palpa board print --board chessboard:9x6:0.025 --paper a3 --out chessboard.pdf\n"
      "  palpa board print --out board.png --dpi 300");
  const auto o = std::make_shared<BoardOptions>();
  CLI::Option* file = command->add_option("--station", o->station, "Station file")
                          ->type_name("FILE")
                          ->check(somethingThere("stations"));
  command
      ->add_option("--board", o->board,
                   "Instead of the station's: tags:, aprilgrid:, chessboard:, charuco: or "
                   "tag36h11:, or a board file")
      ->excludes(file);
  command->add_option("--out", o->out, "PDF or PNG to write (default board.pdf)")
      ->type_name("FILE");
  command->add_option("--paper", o->page.paper, "Paper size (default a4); fit: as large as needed")
      ->check(oneOf(report::papers()));
  command->add_option("--dpi", o->page.dpi, "Dots per inch of a PNG (default 300)")
      ->check(inRange(72, 1200));
  command->callback([o] { print(*o); });
}

}  // namespace palpa::cli
