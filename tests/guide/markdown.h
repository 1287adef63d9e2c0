#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace palpa::guide {

/// A fenced block: what stands after its ```, what stands in it, and the line of the file where
/// that begins.
struct Block {
  std::string language, rest, text;
  int line = 0;
};

struct Link {
  std::string target;
  bool is_picture = false;
  int line = 0;
};

struct Code {
  std::string text;
  int line = 0;
};

/// What a test looks at in a page.
struct Page {
  std::filesystem::path file;
  std::vector<Block> blocks;
  std::vector<Link> links;
  std::vector<Code> code;            ///< between single `
  std::vector<std::string> anchors;  ///< of its headings, as forges make them
};

/// Throws std::runtime_error for a fence without an end.
Page readPage(const std::filesystem::path& file);

}  // namespace palpa::guide
