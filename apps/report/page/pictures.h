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

/// The pictures with caption and moment, embedded as WebP. These of one trial take at most a
/// quarter of what is left of `carried`: they are as large as fits, and where even the smallest do
/// not fit they are shown from their files, which must lie beside the page, and this is said. It
/// depends on what stands before alone: a session's report and what `palpa finish` makes of it show
/// the same trials' pictures in the same way. One that cannot be read (or is no PNG) is named in
/// its place: a lost picture must not cost the report.
void writePictures(Html& html, const std::vector<Picture>& pictures,
                   std::size_t carried = kCarried);

}  // namespace palpa::report
