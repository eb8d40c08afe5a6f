/// Print-quality pictures, drawn by gnuplot.
#pragma once

#include <filesystem>
#include <string>

namespace sonoglide::plot {

/// Finds out whether pictures can be drawn, before anything long is computed for them.
/// @return gnuplot's place
/// @throws process::ProcessError  there is no gnuplot; what() says what to install
std::filesystem::path require_gnuplot();

/// Draws one SVG picture on a white ground.
///
/// @param script  gnuplot commands, the data in them ("$name << EOD" blocks); terminal and output
///                are set already
/// @throws process::ProcessError  gnuplot is missing or refuses the script, which what() quotes
std::string draw_svg(const std::string& script, int width_px, int height_px);

}  // namespace sonoglide::plot
