#include "host_sim/plot/gnuplot.hpp"

#include <fmt/format.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <system_error>

namespace sonoglide::plot {
namespace {

/// A folder of its own that goes when it is done with.
class ScratchFolder {
 public:
  ScratchFolder() {
    std::string name = (std::filesystem::temp_directory_path() / "sonoglide-XXXXXX").string();
    if (mkdtemp(name.data()) == nullptr) {
      throw PlotError(name + ": cannot be created");
    }
    path_ = name;
  }
  ~ScratchFolder() {
    std::error_code ignored;
    std::filesystem::remove_all(path_, ignored);
  }
  ScratchFolder(const ScratchFolder&) = delete;
  ScratchFolder& operator=(const ScratchFolder&) = delete;

  std::filesystem::path file(const char* name) const { return path_ / name; }

 private:
  std::filesystem::path path_;
};

std::string content(const std::filesystem::path& path) {
  std::ifstream file(path, std::ios::binary);
  std::ostringstream text;
  text << file.rdbuf();
  return text.str();
}

/// Runs gnuplot on a script; true if it was content.
bool run_gnuplot(const ScratchFolder& folder, const std::string& script) {
  std::ofstream(folder.file("script"), std::ios::binary) << script;
  const std::string command =
      fmt::format("gnuplot '{}' >'{}' 2>'{}'", folder.file("script").string(),
                  folder.file("picture").string(), folder.file("complaints").string());
  return std::system(command.c_str()) == 0;
}

}  // namespace

void require_gnuplot() {
  if (std::system("gnuplot --version >/dev/null 2>&1") != 0) {
    throw PlotError("gnuplot: cannot be started; on Debian: apt-get install gnuplot-nox");
  }
}

std::string draw_svg(const std::string& script, int width_px, int height_px) {
  require_gnuplot();
  const ScratchFolder folder;
  const std::string head = fmt::format(
      "set terminal svg size {},{} dynamic background rgb 'white' font 'sans-serif,13'\n"
      "set encoding utf8\n",
      width_px, height_px);
  if (!run_gnuplot(folder, head + script)) {
    throw PlotError("gnuplot: " + content(folder.file("complaints")));
  }
  return content(folder.file("picture"));
}

}  // namespace sonoglide::plot
