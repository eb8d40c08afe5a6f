#include "host_sim/cli/output_option.hpp"

#include "host_sim/report/output_folder.hpp"

namespace sonoglide::cli {

void add_output_option(CLI::App& command, std::string& out, const std::string& contents) {
  command.add_option("--out", out, "Folder for " + contents)
      ->type_name("DIR")
      ->check([](const std::string& folder) {
        return folder.empty() ? std::string("is empty; allowed: a folder") : std::string();
      });
}

std::filesystem::path output_folder(const std::string& out, const std::string& name) {
  return out.empty() ? std::filesystem::path("out") / name : std::filesystem::path(out);
}

void require_writable(const std::filesystem::path& out) {
  const report::OutputFolder probe(out);
}

}  // namespace sonoglide::cli
