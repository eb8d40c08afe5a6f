#include "host_sim/output/gnuplot.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <filesystem>
#include <iterator>

#include "host_sim/process/child_process.hpp"
#include "host_sim/process/printable.hpp"

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

std::string data_block(std::string_view name, std::string_view lines) {
  return fmt::format("${} << EOD\n{}EOD\n", name, lines);
}

std::string data_point(double x, double y) {
  return std::isfinite(y) ? fmt::format("{:.9g} {:.9g}\n", x, y) : std::string("\n");
}

std::string range_command(char axis, const std::vector<double>& values, Scale scale, double about) {
  const bool any = std::any_of(values.begin(), values.end(), [scale](double value) {
    return std::isfinite(value) && (scale == Scale::linear || value > 0.0);
  });
  constexpr double factor = 10.0;
  return any ? fmt::format("set {}range [*:*]\n", axis)
             : fmt::format("set {}range [{:g}:{:g}]\n", axis, about / factor, about * factor);
}

std::string draw_svg(const std::string& script, int width_px, int height_px) {
  const std::string terminal = fmt::format(
      "set terminal svg size {},{} dynamic background rgb 'white' font 'sans-serif,13'\n"
      "set encoding utf8\n",
      width_px, height_px);
  // With -d it reads no settings of the user's or the machine's.
  std::string picture =
      process::run_tool({require_gnuplot().string(), "-d", "-"}, terminal + script);
  constexpr std::string_view end = "</svg>";
  if (picture.find(end) == std::string::npos) {
    throw process::ProcessError("gnuplot drew no whole picture");
  }
  return picture;
}

}  // namespace sonoglide::output
