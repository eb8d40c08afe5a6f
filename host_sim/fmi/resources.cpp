#include "host_sim/fmi/resources.hpp"

#include <fmt/format.h>

#include <fstream>
#include <iterator>
#include <stdexcept>

#include "host_sim/configure/read/experiment.hpp"
#include "host_sim/process/checksum.hpp"

namespace sonoglide::fmi {
namespace {

std::string content_of(const std::filesystem::path& path) {
  std::ifstream file(path, std::ios::binary);
  std::string text((std::istreambuf_iterator<char>(file)), std::istreambuf_iterator<char>());
  if (!file) {
    throw std::runtime_error(path.u8string() + ": cannot be read");
  }
  return text;
}

}  // namespace

Resources make_resources(const scene::Scene& scene, loop::Kind kind, const std::string& engine) {
  Resources made{experiment::text_of(scene), kind, {}};
  process::ContentHash hash;
  hash.add(engine);
  hash.add(made.scene);
  hash.add(scene::name_of(loop::kinds, kind));
  made.token = fmt::format("{{sonoglide-{:016x}}}", hash.value());
  return made;
}

Resources read_resources(const std::filesystem::path& folder) {
  const std::string name = content_of(folder / Resources::kind_name);
  const auto kind = scene::value_of(loop::kinds, name);
  if (!kind) {
    throw std::runtime_error((folder / Resources::kind_name).u8string() + ": names no kind of FMU");
  }
  return {content_of(folder / Resources::scene_name), *kind,
          content_of(folder / Resources::token_name)};
}

}  // namespace sonoglide::fmi
