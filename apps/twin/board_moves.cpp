#include "apps/twin/board_moves.h"

namespace palpa::twin {
namespace {

constexpr double kLongest_s = 86'400, kMillimetre = 1e-3;

}  // namespace

std::vector<BoardMove> readBoardMoves(const station::Station& station) {
  std::vector<BoardMove> moves;
  const station::JsonFile& file = station.file;
  if (!file.has("twin/board_moves")) return moves;
  const nlohmann::json& list = file.json().at("twin").at("board_moves");
  if (!list.is_array()) file.refuse("twin/board_moves", "must be a list");
  for (const nlohmann::json& item : list) {
    const station::JsonFile entry(item, file.name() + ", \"twin/board_moves\"");
    const std::string name = entry.text("board");
    BoardMove move;
    while (move.board < station.boards.size() && station.boards[move.board].name != name)
      ++move.board;
    if (move.board == station.boards.size() || !station.boards[move.board].X_WB)
      entry.refuse("board", "is \"" + name + "\", which is no board with an X_WB");
    move.from = entry.number("from_s", 0, kLongest_s);
    move.by = kMillimetre * entry.vector("by_mm");
    moves.push_back(move);
  }
  return moves;
}

std::vector<std::pair<std::size_t, Pose>> boardsAt(const station::Station& station,
                                                   const std::vector<BoardMove>& moves, double t) {
  std::vector<std::pair<std::size_t, Pose>> boards;
  for (std::size_t i = 0; i < station.boards.size(); ++i) {
    if (!station.boards[i].X_WB) continue;
    Pose X_WB = *station.boards[i].X_WB;
    for (const BoardMove& move : moves)
      if (move.board == i && t >= move.from) X_WB.translation() += move.by;
    boards.emplace_back(i, X_WB);
  }
  return boards;
}

}  // namespace palpa::twin
