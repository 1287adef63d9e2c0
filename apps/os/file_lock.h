#pragma once

#include <filesystem>
#include <memory>

namespace palpa::os {

/// A file that one holder at a time has. Given back at the end of its life, or with the process,
/// however that ends.
class FileLock {
 public:
  enum class Missing { fails, is_made };  ///< made: readable by this user alone
  /// Never waits. Null where another holds it, or the file cannot be opened.
  static std::unique_ptr<FileLock> exclusive(const std::filesystem::path& file, Missing missing);
  ~FileLock();
  FileLock(const FileLock&) = delete;
  FileLock& operator=(const FileLock&) = delete;

 private:
  explicit FileLock(int descriptor) : descriptor_(descriptor) {}
  const int descriptor_;
};

/// Somebody holds it now. False where there is no such file.
bool isLocked(const std::filesystem::path& file);

}  // namespace palpa::os
