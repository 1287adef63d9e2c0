#pragma once

#include <cstdint>
#include <filesystem>
#include <vector>

namespace palpa {

/// A picture of a recorded film, NAME.mjpeg, as the table beside it tells of it (NAME.mjpeg.csv: a
/// line for each picture, with its number, its time, and columns that the header names).
struct FilmPicture {
  std::int64_t t_ns = 0;     ///< of its exposure
  std::uint64_t offset = 0;  ///< of its first byte in the film, in a table that has this column
};

/// In the film's order, up to the first line that tells no such thing, as the last one of a killed
/// session may. Times are what the camera said: they may stand still or go back. Empty where there
/// is no table.
std::vector<FilmPicture> filmTable(const std::filesystem::path& film);

}  // namespace palpa
