#include "anatomy/base/whole_file.h"

#include <fcntl.h>
#include <signal.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <cerrno>
#include <charconv>
#include <chrono>
#include <cstdio>
#include <fstream>
#include <map>
#include <mutex>
#include <system_error>

#include "anatomy/base/error.h"

namespace palpa {

namespace {

namespace fs = std::filesystem;

constexpr std::size_t kEnough = 1 << 16;      // bytes that are worth a call
constexpr std::size_t kLongestShown = 180;    // of a name; the system allows 255 bytes
constexpr std::chrono::hours kForgotten{24};  // another computer's process may still be at it

/// A session's evidence and a centre's records are databases; a page or a table that is given their
/// name must not take their place.
bool isDatabase(const fs::path& file) {
  constexpr std::string_view kBegins = "SQLite format 3";
  std::string start(kBegins.size(), ' ');
  std::ifstream stream(file, std::ios::binary);
  return stream.read(start.data(), static_cast<std::streamsize>(start.size())) && start == kBegins;
}

bool isSomethingElse(fs::file_type type) {
  return type == fs::file_type::block || type == fs::file_type::character ||
         type == fs::file_type::fifo || type == fs::file_type::socket;
}

fs::path folderOf(const fs::path& file) {
  return file.has_parent_path() ? file.parent_path() : fs::path(".");
}

std::string besideBegins(const fs::path& file) {
  return "." + file.filename().string().substr(0, kLongestShown) + ".part-";
}

/// The process that wrote `rest`, "PID-N", of a name is no more.
bool isNobodys(std::string_view rest) {
  int process = 0;
  const auto [end, problem] = std::from_chars(rest.data(), rest.data() + rest.size(), process);
  return problem == std::errc() && end != rest.data() + rest.size() && *end == '-' && process > 0 &&
         ::kill(process, 0) != 0 && errno == ESRCH;
}

/// What processes that were killed a day ago or more left of this file.
void removeForgotten(const fs::path& file) {
  const std::string begins = besideBegins(file);
  std::error_code none;
  for (auto entry = fs::directory_iterator(folderOf(file), none);
       !none && entry != fs::directory_iterator(); entry.increment(none)) {
    const std::string name = entry->path().filename().string();
    if (!name.starts_with(begins) || !isNobodys(std::string_view(name).substr(begins.size())))
      continue;
    std::error_code problem;
    const auto written = entry->last_write_time(problem);
    if (!problem && fs::file_time_type::clock::now() - written > kForgotten)
      fs::remove(entry->path(), problem);
  }
}

/// Tries names ".NAME.part-PID-N", and `ending`, until `take` has one; empty: errno says why not.
template <class Take>
fs::path freeNameBeside(const fs::path& file, const std::string& ending, const Take& take) {
  static std::atomic<unsigned> count{0};
  constexpr int kTries = 100;
  const std::string begins = besideBegins(file) + std::to_string(::getpid()) + "-";
  for (int tries = 0; tries < kTries; ++tries) {
    fs::path name = folderOf(file) / (begins + std::to_string(++count) + ending);
    if (take(name)) return name;
    if (errno != EEXIST) break;
  }
  return {};
}

struct Claimed {
  fs::path name;
  int descriptor = -1;  ///< -1: errno says why not
};

/// A new file of such a name.
Claimed claim(const fs::path& file, const std::string& ending, mode_t mode) {
  Claimed claimed;
  claimed.name = freeNameBeside(file, ending, [&](const fs::path& name) {
    claimed.descriptor =
        ::open(name.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_NOFOLLOW | O_CLOEXEC, mode);
    return claimed.descriptor >= 0;
  });
  return claimed;
}

/// A new file that has no name until it is whole, so that a process that is killed leaves nothing
/// of it; -1 where the drive, or the system, has no such files.
int nameless(const fs::path& folder, mode_t mode) {
  if (::access("/proc/self/fd", X_OK) != 0) return -1;
  return ::open(folder.c_str(), O_TMPFILE | O_WRONLY | O_CLOEXEC, mode);
}

/// Its first name, beside the file; empty: errno says why it has none.
fs::path named(int descriptor, const fs::path& file) {
  const std::string open = "/proc/self/fd/" + std::to_string(descriptor);
  return freeNameBeside(file, "", [&](const fs::path& name) {
    return ::linkat(AT_FDCWD, open.c_str(), AT_FDCWD, name.c_str(), AT_SYMLINK_FOLLOW) == 0;
  });
}

}  // namespace

WholeFile::WholeFile(const fs::path& file, Lasts lasts, Readers readers)
    : file_(file), lasts_(lasts), readers_(readers) {
  std::error_code none;
  const fs::file_type there = fs::status(file_, none).type();
  if (there == fs::file_type::directory || file_.filename().empty()) fail(EISDIR);
  if (there == fs::file_type::regular && isDatabase(file_))
    throw Error("holds a session or records, which nothing overwrites", file_.string(),
                "Give another name");
  if (isSomethingElse(there))
    throw Error("is a device or a socket, no file", file_.string(), "Give another name");
  if (lasts_ == Lasts::yes) removeForgotten(file_);
  open();
}

WholeFile::~WholeFile() { discard(); }

namespace {

/// As many may read the new file as the old one.
mode_t modeOf(const fs::path& file) {
  struct stat there {};
  const bool is_file = ::stat(file.c_str(), &there) == 0 && S_ISREG(there.st_mode);
  return is_file ? there.st_mode & 0666 : 0666;
}

}  // namespace

void WholeFile::open() {
  const mode_t mode = readers_ == Readers::owner ? 0600 : modeOf(file_);
  descriptor_ = nameless(folderOf(file_), mode);
  if (descriptor_ >= 0) return;
  Claimed claimed = claim(file_, "", mode);
  beside_ = std::move(claimed.name);
  descriptor_ = claimed.descriptor;
  if (descriptor_ < 0) fail(errno);
}

fs::path claimedBeside(const fs::path& file) {
  const Claimed claimed = claim(file, file.extension().string(), 0600);
  if (claimed.descriptor < 0) failFile("cannot be written", file, errno);
  ::close(claimed.descriptor);
  return claimed.name;
}

void WholeFile::write(std::string_view text) {
  waiting_ += text;
  if (waiting_.size() >= kEnough) flush();
}

void WholeFile::flush() {
  for (std::string_view left = waiting_; !left.empty();) {
    const ssize_t count = ::write(descriptor_, left.data(), left.size());
    if (count < 0 && errno != EINTR) fail(errno);
    if (count > 0) left.remove_prefix(static_cast<std::size_t>(count));
  }
  waiting_.clear();
}

void WholeFile::finish() {
  flush();
  if (lasts_ == Lasts::yes && ::fsync(descriptor_) != 0 && errno != EINVAL && errno != ENOTSUP)
    fail(errno);
  if (beside_.empty()) beside_ = named(descriptor_, file_);
  if (beside_.empty()) fail(errno);
  const int descriptor = descriptor_;
  descriptor_ = -1;
  std::error_code none;
  const bool is_new = !fs::exists(fs::symlink_status(file_, none));
  const bool closed = ::close(descriptor) == 0 || errno == EINTR;
  if (!closed || std::rename(beside_.c_str(), file_.c_str()) != 0) {
    const int reason = errno;
    ::unlink(beside_.c_str());
    failFile("cannot be written", file_, reason);
  }
  if (is_new) WrittenTogether::note(file_);
}

void WholeFile::discard() noexcept {
  if (descriptor_ < 0) return;
  ::close(descriptor_);
  if (!beside_.empty()) ::unlink(beside_.c_str());
  descriptor_ = -1;
}

void WholeFile::fail(int reason) {
  discard();
  failFile("cannot be written", file_, reason);
}

void writeWhole(const fs::path& file, std::string_view content, Lasts lasts, Readers readers) {
  WholeFile whole(file, lasts, readers);
  whole.write(content);
  whole.finish();
}

namespace {

struct Noted {
  std::mutex mutex;
  std::vector<fs::path> made;
  bool notes = false;
};

Noted& noted() {
  static Noted one;
  return one;
}

}  // namespace

WrittenTogether::WrittenTogether() {
  const std::lock_guard lock(noted().mutex);
  first_ = !noted().notes;
  noted().notes = true;
}

WrittenTogether::~WrittenTogether() {
  if (!first_) return;
  const std::lock_guard lock(noted().mutex);
  for (auto made = noted().made.rbegin(); made != noted().made.rend(); ++made) {
    std::error_code ignored;
    fs::remove(*made, ignored);
  }
  noted().made.clear();
  noted().notes = false;
}

void WrittenTogether::keep() {
  if (!first_) return;
  const std::lock_guard lock(noted().mutex);
  noted().made.clear();
  noted().notes = first_ = false;
}

void WrittenTogether::note(const fs::path& made) {
  const std::lock_guard lock(noted().mutex);
  if (!noted().notes) return;
  std::error_code none;
  noted().made.push_back(fs::absolute(made, none));
}

std::vector<fs::path> entriesOf(const fs::path& folder) {
  std::vector<fs::path> all;
  std::error_code none;
  for (auto entry = fs::directory_iterator(folder, none); entry != fs::directory_iterator();
       entry.increment(none))
    all.push_back(entry->path());
  std::sort(all.begin(), all.end());
  return all;
}

std::optional<std::string> readWhole(const fs::path& file) {
  std::ifstream stream(file, std::ios::binary);
  if (!stream) return std::nullopt;
  std::string bytes;
  std::array<char, 1 << 16> part;
  do {
    stream.read(part.data(), part.size());
    bytes.append(part.data(), static_cast<std::size_t>(stream.gcount()));
  } while (stream);
  if (stream.bad()) return std::nullopt;
  return bytes;
}

namespace {

constexpr const char kOtherPlace[] = "Choose another place, or correct who may write there";

const std::map<int, FileTrouble>& troubles() {
  static const std::map<int, FileTrouble> kTroubles{
      {ENOSPC, {"the disk is full", "Free some space there"}},
      {EDQUOT, {"your share of this disk is used up", "Remove files of yours there"}},
      {EFBIG,
       {"it would be larger than a file may be here", "Raise the limit: ulimit -f unlimited"}},
      {EIO, {"the disk does not read or write as it should", "Check the drive and its cable"}},
      {EACCES, {"you may not write there", kOtherPlace}},
      {EPERM, {"you may not write there", kOtherPlace}},
      {EROFS, {"the disk can only be read", "Choose another place"}},
      {EMFILE,
       {"the program has too many files open", "Raise the limit: ulimit -n 1024, and try again"}},
      {ENFILE, {"the computer has too many files open", "Close other programs, and try again"}},
      {EAGAIN, {"too many processes run already", "Close other programs, and try again"}},
      {ENOMEM, {"there is not enough memory", "Close other programs, and try again"}},
      {ENAMETOOLONG, {"the name is too long", "Give a shorter one"}},
      {ELOOP, {"a link stands in the way", "Remove the link, or choose another place"}},
      {ENOENT, {"its folder does not exist", "Make the folder first, or choose another place"}},
      {ENOTDIR, {"a file stands where a folder must be", "Choose another place"}},
      {EISDIR, {"there is a folder of this name", "Give another name"}},
      {ENOTEMPTY, {"there is a folder of this name", "Give another name"}},
      {EEXIST, {"there is one of this name", "Give another name"}},
      {EBUSY, {"another program holds it", "Close that program, and try again"}},
      {ETXTBSY, {"another program holds it", "Close that program, and try again"}},
      {ENODEV, {"the disk is gone", "Connect it again, or choose another place"}},
      {ENXIO, {"the disk is gone", "Connect it again, or choose another place"}}};
  return kTroubles;
}

}  // namespace

FileTrouble fileTrouble(int error) {
  const auto known = troubles().find(error);
  if (known != troubles().end()) return known->second;
  return {"the system refuses it, error " + std::to_string(error),
          "Check the folder and its disk, or choose another place"};
}

std::string whyUnread(const std::error_code& error) {
  if (error == std::errc::no_such_file_or_directory) return "there is no such file";
  if (error == std::errc::permission_denied) return "you may not read it";
  return fileTrouble(error.value()).why;
}

void failFile(const std::string& what, const std::filesystem::path& file, int error,
              const std::string& instead) {
  const FileTrouble trouble = fileTrouble(error);
  throw Error(what + " (" + trouble.why + ")", file.string(),
              trouble.remedy + (instead.empty() ? "" : ". " + instead));
}

void failFile(const std::string& what, const std::filesystem::path& file,
              const std::error_code& error, const std::string& instead) {
  failFile(what, file, error.value(), instead);
}

}  // namespace palpa
