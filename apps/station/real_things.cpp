#include "apps/station/real_things.h"

#include <algorithm>

#include "apps/station/device_setup.h"

namespace palpa::station {
namespace {

constexpr double kMillimetre = 1e-3;

bool shareTags(const ar::TagGridSpec& a, const ar::TagGridSpec& b) {
  return a.first_id < b.first_id + b.columns * b.rows &&
         b.first_id < a.first_id + a.columns * a.rows;
}

double unitOf(const JsonFile& entry) {
  const std::string unit = entry.text("unit");
  if (unit == "m") return 1;
  if (unit == "cm") return 1e-2;
  if (unit == "mm") return kMillimetre;
  entry.refuse("unit", "is \"" + unit + "\"; known are m, cm, mm");
}

}  // namespace

ar::TagGridSpec readBoard(const JsonFile& file, const std::string& at) {
  ar::TagGridSpec board;
  board.columns = file.integer(at + "/columns", 1, 30);
  board.rows = file.integer(at + "/rows", 1, 30);
  board.tag_size = kMillimetre * file.number(at + "/tag_size_mm", 2, 500);
  board.spacing = kMillimetre * file.number(at + "/spacing_mm", 0.5, 500);
  board.first_id = file.integer(at + "/first_id", 0, 586);
  ar::validate(board, file.name() + ", \"" + at + "\"");
  return board;
}

std::vector<OtherBoard> readOtherBoards(const JsonFile& file,
                                        const std::vector<ar::TagGridSpec>& others) {
  std::vector<OtherBoard> boards;
  std::vector<ar::TagGridSpec> known = others;
  for (const JsonFile& entry : file.entries("boards")) {
    OtherBoard board;
    board.name = entry.text("name");
    board.grid = readBoard(entry, "");
    if (entry.has("X_WB")) board.X_WB = readPose(entry, "X_WB");
    if (entry.has("tolerance_mm"))
      board.tolerance = kMillimetre * entry.number("tolerance_mm", 1, 100);
    const bool taken = board.name == "table" || board.name == "tool" ||
                       std::any_of(boards.begin(), boards.end(),
                                   [&](const OtherBoard& b) { return b.name == board.name; });
    if (taken) entry.refuse("name", "is \"" + board.name + "\", which is another's name");
    if (std::any_of(known.begin(), known.end(),
                    [&](const ar::TagGridSpec& grid) { return shareTags(grid, board.grid); }))
      entry.refuse("first_id", "makes tags that another board has, too");
    known.push_back(board.grid);
    boards.push_back(std::move(board));
  }
  return boards;
}

std::vector<RealThing> readRealThings(const JsonFile& file, const std::filesystem::path& base,
                                      const std::vector<OtherBoard>& boards) {
  std::vector<RealThing> things;
  for (const JsonFile& entry : file.entries("real_things")) {
    RealThing thing;
    thing.mesh = base / entry.text("mesh");
    thing.metres = unitOf(entry);
    thing.X = readPose(entry, "X");
    const std::string on = entry.text("on");
    const auto board = std::find_if(boards.begin(), boards.end(),
                                    [&](const OtherBoard& b) { return b.name == on; });
    if (on == "table")
      thing.on = RealThing::On::table;
    else if (on == "tool")
      thing.on = RealThing::On::tool;
    else if (board == boards.end())
      entry.refuse("on", "is \"" + on + "\"; known are table, tool, and the names of \"boards\"");
    else
      thing.on = RealThing::On::board;
    thing.board = static_cast<std::size_t>(board - boards.begin());
    things.push_back(std::move(thing));
  }
  return things;
}

}  // namespace palpa::station
