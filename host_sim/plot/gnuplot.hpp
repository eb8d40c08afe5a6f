/// Print-quality pictures, drawn by gnuplot.
#pragma once

#include <stdexcept>
#include <string>

namespace sonoglide::plot {

/// gnuplot is missing or refused a script; the message says which and quotes it.
class PlotError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// Finds out whether pictures can be drawn, before anything long is computed for them.
/// @throws PlotError if gnuplot cannot be started
void require_gnuplot();

/// Draws one SVG picture on a white ground.
///
/// @param script  gnuplot commands, the data in them ("$name << EOD" blocks); terminal and output
///                are set already
/// @throws PlotError if gnuplot cannot be started or refuses the script
std::string draw_svg(const std::string& script, int width_px, int height_px);

}  // namespace sonoglide::plot
