#include "host_sim/output/gnuplot.hpp"

#include <fmt/format.h>

#include <cctype>
#include <filesystem>
#include <fstream>
#include <iterator>

#include "host_sim/process/printable.hpp"
#include "host_sim/process/run_tool.hpp"
#include "host_sim/process/scratch_folder.hpp"

namespace sonoglide::output {

std::filesystem::path require_gnuplot() {
  return process::require_program("gnuplot", "gnuplot-nox");
}

std::string quoted(std::string_view text) {
  constexpr std::string_view plain = " .,:+-=_/()[]<>";
  std::string string = "\"";
  for (const char each : process::printable(text)) {
    const auto byte = static_cast<unsigned char>(each);
    if (std::isalnum(byte) != 0 || byte >= 0x80 || plain.find(each) != std::string_view::npos) {
      string += each;
    } else {
      fmt::format_to(std::back_inserter(string), "\\{:03o}", byte);
    }
  }
  return string + '"';
}

std::string draw_svg(const std::string& script, int width_px, int height_px) {
  const std::filesystem::path gnuplot = require_gnuplot();
  const process::ScratchFolder folder(std::filesystem::temp_directory_path());
  const std::filesystem::path script_file = folder.path() / "script";
  const std::filesystem::path picture_file = folder.path() / "picture";
  std::ofstream(script_file, std::ios::binary)
      << fmt::format(
             "set terminal svg size {},{} dynamic background rgb 'white' font 'sans-serif,13'\n"
             "set encoding utf8\n"
             "set output ARG1\n",
             width_px, height_px)
      << script;
  process::run_tool({gnuplot.string(), "-c", script_file.string(), picture_file.string()}, {});
  std::ifstream picture(picture_file, std::ios::binary);
  return {std::istreambuf_iterator<char>(picture), std::istreambuf_iterator<char>()};
}

}  // namespace sonoglide::output
