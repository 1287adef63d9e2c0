#pragma once

#include <string>
#include <vector>

#include "anatomy/patient.h"

namespace palpa::anatomy {

/// The picture as the bytes of a PNG file, 8 bits RGB. Throws Error when it is none (sizes that do
/// not fit its bytes).
std::vector<unsigned char> pngOf(const RgbPicture& texture, const std::string& where);

/// The other way, from bytes that nobody vouches for. What the header claims is checked before
/// anything is decoded: a PNG of 8 bits a channel, at most 4096 x 4096, with no more bytes than its
/// pixels need. Transparency is dropped. Throws Error; `where` begins every message.
RgbPicture textureOfPng(const unsigned char* bytes, std::size_t size, const std::string& where);

}  // namespace palpa::anatomy
