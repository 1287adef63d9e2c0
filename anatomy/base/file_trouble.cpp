#include "anatomy/base/file_trouble.h"

#include <cerrno>
#include <map>

#include "anatomy/base/error.h"

namespace palpa {
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
