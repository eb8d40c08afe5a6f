/// Any bytes are either a scene or a SceneError, and what was accepted is echoed as itself.
///
/// The bytes before the first NUL are the file; each further NUL-ended piece is a `--set` option.
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <string>
#include <vector>

#include "host_sim/configure/read/experiment.hpp"
#include "host_sim/scene_file/echo.hpp"

namespace {

std::vector<std::string> pieces_of(const std::string& bytes) {
  std::vector<std::string> pieces;
  std::size_t begin = 0;
  for (std::size_t end = bytes.find('\0'); end != std::string::npos;
       begin = end + 1, end = bytes.find('\0', begin)) {
    pieces.push_back(bytes.substr(begin, end - begin));
  }
  pieces.push_back(bytes.substr(begin));
  return pieces;
}

void check_one_line(const sonoglide::scene_file::SceneError& error) {
  const std::string what = error.what();
  if (error.line() < 1 || error.column() < 1 || error.key().empty() || error.message().empty() ||
      what.find('\n') != std::string::npos) {
    std::abort();
  }
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace sonoglide::scene_file;
  std::vector<std::string> pieces =
      pieces_of(std::string(reinterpret_cast<const char*>(data), size));
  const std::string text = pieces.front();
  pieces.erase(pieces.begin());
  nlohmann::ordered_json echo;
  try {
    echo = to_json(sonoglide::experiment::read_text(text, "fuzz.toml", pieces).nominal);
  } catch (const SceneError& error) {
    check_one_line(error);
    return 0;
  }
  if (to_json(sonoglide::experiment::read_text(to_toml(echo), "echo.toml").nominal) != echo) {
    std::abort();
  }
  return 0;
}
