#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <system_error>
#include <vector>

namespace palpa {

/// `yes`: on the disk before it takes its name, so that a power cut leaves the old file or the new
/// one. `no`: for what is made again easily, or in great numbers.
enum class Lasts { yes, no };

/// Of a new file: whom the umask lets, or its owner alone. One that takes the place of another is
/// read by no more than that one.
enum class Readers { by_umask, owner };

/// A file that is there whole or not at all: written without a name (on drives that have no such
/// files, beside as ".NAME.part-PID-N") and named by finish(), so that of a killed process nothing
/// is left. What fails or is left unfinished is removed. A link of the file's name is replaced,
/// never followed. Never takes the place of a session or of records. All throw Error.
class WholeFile {
 public:
  explicit WholeFile(const std::filesystem::path& file, Lasts lasts = Lasts::yes,
                     Readers readers = Readers::by_umask);
  ~WholeFile();
  WholeFile(const WholeFile&) = delete;
  WholeFile& operator=(const WholeFile&) = delete;

  void write(std::string_view text);
  void finish();

 private:
  void open();
  void flush();
  void discard() noexcept;
  [[noreturn]] void fail(int reason);

  std::filesystem::path file_, beside_;
  Lasts lasts_;
  Readers readers_;
  std::string waiting_;  ///< to be written
  int descriptor_ = -1;
};

void writeWhole(const std::filesystem::path& file, std::string_view content,
                Lasts lasts = Lasts::yes, Readers readers = Readers::by_umask);

/// An empty file beside `file`, for a writer that opens it by its name: hidden, of the same ending,
/// and new. Whoever asked renames or removes it. Throws Error.
std::filesystem::path claimedBeside(const std::filesystem::path& file);

/// What a command writes belongs together: the files that were not there before, written by
/// WholeFile while this lives, are gone again at its end, unless they are kept. One at a time; a
/// second one within does nothing of its own.
class WrittenTogether {
 public:
  WrittenTogether();
  ~WrittenTogether();
  WrittenTogether(const WrittenTogether&) = delete;
  WrittenTogether& operator=(const WrittenTogether&) = delete;
  void keep();
  /// A file or a folder that was made just now; of folders the empty ones go.
  static void note(const std::filesystem::path& made);

 private:
  bool first_;
};

/// What lies in a folder itself, in the order of names; nothing where it cannot be read.
std::vector<std::filesystem::path> entriesOf(const std::filesystem::path& folder);

/// The bytes of a file; nullopt where it cannot be read or is a folder. How large a file may be is
/// the caller's question.
std::optional<std::string> readWhole(const std::filesystem::path& file);

/// Why a file could not be made, written or renamed, in words, and what to do about it.
struct FileTrouble {
  std::string why;  ///< a clause: "the disk is full"
  std::string remedy;
};

/// `error`: errno, or the value of an error_code of the system.
FileTrouble fileTrouble(int error);

/// Why a file could not be read, in words: a clause, "there is no such file".
std::string whyUnread(const std::error_code& error);

/// Throws Error: `what` and why, of this file or folder. `instead`: the way out that the caller
/// knows ("Choose another folder with --out"); it is added to what helps in any case.
[[noreturn]] void failFile(const std::string& what, const std::filesystem::path& file, int error,
                           const std::string& instead = "");
[[noreturn]] void failFile(const std::string& what, const std::filesystem::path& file,
                           const std::error_code& error, const std::string& instead = "");

}  // namespace palpa
