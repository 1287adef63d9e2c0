#pragma once

#include <memory>
#include <string>
#include <string_view>

struct _cairo_surface;  // NOLINT(bugprone-reserved-identifier): Cairo's own name

namespace palpa::report {

/// A picture that a page is to carry: decoded once, coded as small as it is shown.
class SmallPicture {
 public:
  /// `png`: the bytes of a file.
  explicit SmallPicture(std::string_view png);

  bool isThere() const { return wide_ > 0; }  ///< the bytes were a PNG
  int wide() const { return wide_; }          ///< px
  /// The bytes of a WebP file, lossy, no wider than `wide` (px; at least 1). The same bytes every
  /// time. Throws Error without memory.
  std::string webp(int wide) const;

 private:
  std::shared_ptr<_cairo_surface> surface_;
  int wide_ = 0, high_ = 0;
};

}  // namespace palpa::report
