#include "host_sim/fmi/resources.hpp"

#include <fmt/format.h>

#include <fstream>
#include <iterator>
#include <stdexcept>

#include "host_sim/process/checksum.hpp"
#include "host_sim/scene_file/to_json.hpp"
#include "host_sim/scene_file/to_toml.hpp"

namespace sonoglide::fmi {
namespace {

std::string content_of(const std::filesystem::path& path) {
  std::ifstream file(path, std::ios::binary);
  std::string text((std::istreambuf_iterator<char>(file)), std::istreambuf_iterator<char>());
  if (!file) {
    throw std::runtime_error(path.string() + ": cannot be read");
  }
  return text;
}

}  // namespace

std::string words_of(Content content) {
  return std::string(scene::name_of(stepped::kinds, content.kind)) +
         (content.clock ? " clock" : "");
}

Resources make_resources(const scene::Scene& scene, Content content, const std::string& engine) {
  Resources made{scene_file::to_toml(scene_file::to_json(scene)), content, {}};
  process::ContentHash hash;
  hash.add(engine);
  hash.add(made.scene);
  hash.add(words_of(content));
  made.token = fmt::format("{{sonoglide-{:016x}}}", hash.value());
  return made;
}

Resources read_resources(const std::filesystem::path& folder) {
  const std::string words = content_of(folder / Resources::kind_name);
  for (const scene::Named<stepped::Kind>& each : stepped::kinds) {
    for (const bool clock : {false, true}) {
      const Content content{each.value, clock};
      if (words_of(content) == words) {
        return {content_of(folder / Resources::scene_name), content,
                content_of(folder / Resources::token_name)};
      }
    }
  }
  throw std::runtime_error((folder / Resources::kind_name).string() + ": names no kind of FMU");
}

}  // namespace sonoglide::fmi
