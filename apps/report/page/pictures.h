#pragma once

#include <cstddef>
#include <filesystem>
#include <string>
#include <vector>

#include "apps/report/page/html.h"

namespace palpa::report {

struct Picture {
  std::filesystem::path file;  ///< PNG beside the report
  std::string caption;
  double t_s = -1;  ///< moment in the trial; < 0: none
};

/// Bytes of pictures that a page carries in itself, so that it can be mailed: with its charts and
/// words 1 MB.
inline constexpr std::size_t kCarried = 560'000;

/// Whose pictures they are: those of a trial leave room for further ones.
enum class PicturesOf { trial, session };

/// The pictures with caption and moment, embedded as WebP. Those of a trial take at most a quarter
/// of what is left of kCarried, those of a session all of it: they are as large as fits, and where
/// even the smallest do not fit, the page names their files. It depends on what stands before
/// alone: a session's report and what `palpa finish` makes of it show the same trials' pictures in
/// the same way. One that cannot be read (or is no PNG) is named in its place: a lost picture must
/// not cost the report.
void writePictures(Html& html, const std::vector<Picture>& pictures,
                   PicturesOf whose = PicturesOf::trial);

}  // namespace palpa::report
