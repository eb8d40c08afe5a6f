/// The boards whose images this build has.
#pragma once

#include <algorithm>
#include <string>
#include <vector>

namespace sonoglide::emulated {

inline std::vector<std::string> tested_boards() {
  return {SONOGLIDE_TESTED_BOARDS};
}

inline bool is_tested(const std::string& board) {
  const std::vector<std::string> all = tested_boards();
  return std::find(all.begin(), all.end(), board) != all.end();
}

}  // namespace sonoglide::emulated
