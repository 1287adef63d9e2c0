#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace palpa::anatomy {

/// What to do about a file that is not read.
inline constexpr const char* kVolumeRemedy = "Export the volume again or take another file";

enum class VoxelType { int8, uint8, int16, uint16, int32, uint32, float32, float64 };

std::size_t bytesOf(VoxelType type);

/// `count` values of `bytes`, other byte order when `swapped`; value * slope + intercept. What is
/// not finite becomes the least finite value: some programs write NaN where there is no body.
/// Throws Error when bytes are missing or nothing is finite.
std::vector<float> voxelsOf(std::string_view bytes, VoxelType type, std::size_t count, bool swapped,
                            double slope, double intercept, const std::string& where);

/// Inflates zlib or gzip data to at most `size` bytes. With `whole`, to exactly that: less or more
/// is an error, and so is a claim beyond the 1032-fold that deflate can reach, before memory is
/// taken.
std::string inflated(std::string_view packed, std::size_t size, bool whole,
                     const std::string& where);

}  // namespace palpa::anatomy
