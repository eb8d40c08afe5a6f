#include "tests/acceptance/program/odd_names.hpp"

#include <algorithm>
#include <nlohmann/json.hpp>

namespace sonoglide::acceptance {

bool is_printable(const std::string& text) {
  const bool controls = std::any_of(text.begin(), text.end(), [](char c) {
    return (c >= 0 && c < ' ' && c != '\n') || c == 0x7f;
  });
  try {
    // Throws where the text is not UTF-8.
    return !controls && !nlohmann::json(text).dump().empty();
  } catch (const nlohmann::json::exception&) {
    return false;
  }
}

}  // namespace sonoglide::acceptance
