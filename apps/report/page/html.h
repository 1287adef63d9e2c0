#pragma once

#include <initializer_list>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "anatomy/base/whole_file.h"
#include "apps/language/markup.h"

namespace palpa::report {

/// Text made safe for element content and quoted attributes: & < > " ' become entities, control
/// characters vanish, bytes that are no UTF-8 become U+FFFD.
std::string escaped(std::string_view text);

using Attributes = std::initializer_list<std::pair<std::string_view, std::string_view>>;

/// Builds HTML and SVG with every text escaped and every element closed.
class Html {
 public:
  Html() = default;
  explicit Html(WholeFile& file) : file_(&file) {}

  /// Opens an element for the life of the returned scope.
  class Scope {
   public:
    explicit Scope(Html& html) : html_(html) {}
    ~Scope() { html_.close(); }
    Scope(const Scope&) = delete;
    Scope& operator=(const Scope&) = delete;

   private:
    Html& html_;
  };
  [[nodiscard]] Scope in(std::string_view tag, Attributes attributes = {}) {
    open(tag, attributes);
    return Scope(*this);
  }

  void element(std::string_view tag, Attributes attributes, std::string_view text);
  void element(std::string_view tag, std::string_view text) { element(tag, {}, text); }
  void empty(std::string_view tag, Attributes attributes);  ///< written <tag .../>
  void text(std::string_view text) { out_ += escaped(text); }
  void raw(std::string_view markup) { out_ += markup; }  ///< only for markup made here
  void append(const Html& other) { out_ += other.out_; }

  const std::string& str() const { return out_; }
  /// A whole page as it is written for people, in the language of this process.
  std::string page() const { return language::pageIn(out_, language::written()); }
  /// Bytes of pictures in the page, as whoever writes them has counted them.
  std::size_t pictureBytes() const { return picture_bytes_; }
  void countPicture(std::size_t bytes) { picture_bytes_ += bytes; }
  /// Between any two elements: what is written so far goes into the page's file, so that a long
  /// page is never in memory whole. Without a file nothing happens. Throws Error.
  void passOn();

 private:
  void open(std::string_view tag, Attributes attributes);
  void close();
  void head(std::string_view tag, Attributes attributes);

  WholeFile* file_ = nullptr;
  language::PageSpeaker speaker_{language::written()};  ///< of what goes into the file
  std::size_t picture_bytes_ = 0;
  std::string out_;
  std::vector<std::string> open_;
};

}  // namespace palpa::report
