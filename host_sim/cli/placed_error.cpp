#include "host_sim/cli/placed_error.hpp"

#include <fstream>
#include <iterator>

#include "host_sim/scene/document.hpp"

namespace sonoglide::cli {

scene::SceneError placed(const scene::ConfigurationError& error, const std::string& path,
                         const std::vector<std::string>& overrides) {
  std::ifstream file(path, std::ios::binary);
  const std::string text{std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>()};
  return {scene::Document(text, path, overrides).place_of(error.key()), error.key(), error.what()};
}

}  // namespace sonoglide::cli
