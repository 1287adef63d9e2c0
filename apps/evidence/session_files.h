#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace palpa::evidence {

/// Whose session an evidence file holds.
struct EvidenceOwner {
  std::string uuid, trainee;
};
/// Both empty for a file that is not there or cannot be read.
EvidenceOwner ownerOf(const std::filesystem::path& evidence);

enum class RemovalEnd {
  removed,    ///< nothing of the session is here any more, but for what `troubles` names
  absent,     ///< no evidence is in this place of this computer
  another,    ///< another session's evidence is in its place: that stays
  unreadable  ///< it does not say whose it is: that stays
};

struct SessionRemoval {
  RemovalEnd end = RemovalEnd::absent;
  std::size_t files = 0;                    ///< removed
  std::vector<std::string> troubles;        ///< what could not be removed and why, in words
  std::vector<std::filesystem::path> kept;  ///< what stays in its folder: no session wrote it
};

/// Removes what a session left: its evidence, report, table, pictures, films, demonstration; its
/// folder where nothing else is in it. Files that no session writes stay; so does another session's
/// evidence, beside which only pages and tables that name the trainee go. Throws nothing.
SessionRemoval removeSession(const std::filesystem::path& evidence, const EvidenceOwner& owner);

/// Pages of practice that name a trainee, trainee.html and cohort.html in a folder below `folder`:
/// they can be made again of those who remain. Returns what was removed; what could not be goes to
/// `troubles`.
std::vector<std::filesystem::path> removePracticePages(const std::filesystem::path& folder,
                                                       const std::string& trainee,
                                                       std::vector<std::string>* troubles);

}  // namespace palpa::evidence
