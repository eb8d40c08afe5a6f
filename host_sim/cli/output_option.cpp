#include "host_sim/cli/output_option.hpp"

#include <fmt/format.h>

#include <cstdint>

#include "host_sim/output/output_folder.hpp"
#include "host_sim/text/checksum.hpp"
#include "host_sim/text/printable.hpp"

namespace sonoglide::cli {
namespace {

/// A name that is no path, no parent, and leaves room for a suffix in the 255 bytes that file
/// systems allow.
std::string folder_name(const std::string& scene_name) {
  constexpr std::size_t most_bytes = 200;
  std::string name = text::printable(scene_name);
  if (name.find_first_not_of('.') == std::string::npos) {
    return "scene";
  }
  if (name.size() <= most_bytes) {
    return name;
  }
  const auto continues = [&name](std::size_t at) {
    return (static_cast<std::uint8_t>(name[at]) & 0xc0U) == 0x80;
  };
  std::size_t end = most_bytes;
  while (continues(end)) {
    --end;
  }
  return fmt::format("{}-{:016x}", name.substr(0, end), text::checksum(name));
}

}  // namespace

void add_output_option(CLI::App& command, std::string& out, const std::string& contents) {
  command.add_option("--out", out, "Folder for " + contents)
      ->type_name("DIR")
      ->check([](const std::string& folder) {
        return folder.empty() ? std::string("is empty; allowed: a folder") : std::string();
      });
}

std::filesystem::path output_folder(const std::string& out, const std::string& scene_name,
                                    const std::string& suffix) {
  return out.empty() ? std::filesystem::path("out") / (folder_name(scene_name) + suffix)
                     : std::filesystem::path(out);
}

void require_writable(const std::filesystem::path& out, const std::vector<std::string>& names) {
  const output::OutputFolder probe(out, names);
}

}  // namespace sonoglide::cli
