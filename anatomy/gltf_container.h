#pragma once

#include <tiny_gltf.h>

#include <string>

namespace palpa::anatomy {

/// Loads a glTF binary file that nobody vouches for. Magic, version, lengths and depth of nesting
/// are checked before the parser sees it, and the parser may open no other file. What the model
/// refers to (indices, accessors, ranges) is still to be checked by the reader. Throws Error.
tinygltf::Model readGltfBinary(const std::string& file);
/// The same from bytes; `where` begins every message.
tinygltf::Model parseGltfBinary(const std::string& bytes, const std::string& where);

}  // namespace palpa::anatomy
