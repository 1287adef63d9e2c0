#include "tests/openxr_runtime/ledger.h"

#include <fstream>

namespace palpa::test_xr {

void Ledger::closeAll(const std::string& kind) {
  std::erase_if(open_, [&](const auto& entry) { return entry.second == kind; });
}

int Ledger::calls(const std::string& function) const {
  const auto found = calls_.find(function);
  return found == calls_.end() ? 0 : found->second;
}

void Ledger::write(const std::string& file) const {
  if (file.empty()) return;
  std::ofstream out(file);
  for (const auto& [name, count] : calls_) out << "call " << name << ' ' << count << '\n';
  for (const auto& [handle, kind] : open_) out << "open " << kind << '\n';
  for (const std::string& complaint : complaints_) out << "complaint " << complaint << '\n';
  for (const std::string& line : notes_) out << line << '\n';
}

}  // namespace palpa::test_xr
