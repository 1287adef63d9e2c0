#pragma once

#include <tiny_gltf.h>

#include <string>
#include <string_view>
#include <vector>

#include "anatomy/geometry/pose.h"
#include "anatomy/patient.h"

/// The one place where anatomy meets glTF's axes: glTF has +y up and +z toward the viewer of the
/// model's front, so x_G = x_A, y_G = z_A, z_G = -y_A (a turn, no mirror). Both are in metres.
namespace palpa::anatomy {

inline Vec3 gltfFromA(const Vec3& v_A) { return {v_A.x(), v_A.z(), -v_A.y()}; }
inline Vec3 aFromGltf(const Vec3& v_G) { return {v_G.x(), -v_G.z(), v_G.y()}; }

/// Loads a glTF binary file that nobody vouches for. Magic, version, lengths and depth of nesting
/// are checked before the parser sees it, and the parser may open no other file. What the model
/// refers to (indices, accessors, ranges) is still to be checked by the reader. Throws Error.
tinygltf::Model readGltfBinary(const std::string& file);
/// The same from the file's bytes; `where` begins every message.
tinygltf::Model parseGltfBinary(std::string_view bytes, const std::string& where);

/// The picture as the bytes of a PNG file, 8 bits RGB. Throws Error when it is none (sizes that do
/// not fit its bytes).
std::vector<unsigned char> pngOf(const RgbPicture& texture, const std::string& where);

/// The other way, from bytes that nobody vouches for. What the header claims is checked before
/// anything is decoded: a PNG of 8 bits a channel, at most 4096 x 4096, with no more bytes than its
/// pixels need. Transparency is dropped. Throws Error; `where` begins every message.
RgbPicture textureOfPng(const unsigned char* bytes, std::size_t size, const std::string& where);

}  // namespace palpa::anatomy
