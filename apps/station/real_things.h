#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "apps/station/json_file.h"
#include "ar/board.h"

namespace palpa::station {

/// A grid of tags: columns, rows, tag_size_mm, spacing_mm, first_id.
ar::TagGridSpec readBoard(const JsonFile& file, const std::string& at);

/// A board that the camera looks for besides the table's, on the phantom or on the instrument:
/// "boards" of a station's file, a list of
/// {"name", the grid's fields, "X_WB", "tolerance_mm"}. B: the frame of its grid, as W is the
/// table's.
struct OtherBoard {
  std::string name;
  ar::TagGridSpec grid;
  std::optional<Pose>
      X_WB;  ///< where it belongs, if it belongs anywhere: it is told when it is elsewhere
  double tolerance = 0.003;  ///< m
};

/// A real thing that hides virtual ones in the camera's picture: "real_things", a list of {"mesh":
/// FILE, "unit": "mm", "on": "table" | "tool" | a board's name, "X": pose}.
struct RealThing {
  enum class On { table, tool, board };
  std::filesystem::path mesh;
  double metres = 1e-3;  ///< of the file's unit
  On on = On::table;
  std::size_t board = 0;      ///< index of "boards"
  Pose X = Pose::Identity();  ///< of the mesh in W, T or B
};

/// Throw UsageError: two boards with one name, tags that two boards share, a board that is not
/// there.
std::vector<OtherBoard> readOtherBoards(const JsonFile& file,
                                        const std::vector<ar::TagGridSpec>& others);
std::vector<RealThing> readRealThings(const JsonFile& file, const std::filesystem::path& base,
                                      const std::vector<OtherBoard>& boards);

}  // namespace palpa::station
