/// Print-quality pictures, drawn by gnuplot.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace sonoglide::output {

/// Finds out whether pictures can be drawn, before anything long is computed for them.
/// @return gnuplot's place
/// @throws process::ProcessError  there is no gnuplot; what() says what to install
std::filesystem::path require_gnuplot();

/// A text as a string of gnuplot's, with its quotes: double ones, and every sign that gnuplot could
/// take for more than itself by its octal code. (In single quotes a doubled one stands for itself
/// only behind another sign: neither `'a` nor `a''b` can be written so.) Printable, see
/// process::printable(); write `noenhanced` after it where no mark-up is meant.
std::string quoted(std::string_view text);

/// Data that a script plots as `$NAME`. Gnuplot refuses to plot a block without a line.
std::string data_block(std::string_view name, std::string_view lines);

/// A line of a block; a blank one, which is a gap, where y is not finite.
std::string data_point(double x, double y);

enum class Scale { linear, logarithmic };

/// The command that sets the range of an axis, `x` or `y`: left to gnuplot where it can draw some of
/// the values, else about a place. Gnuplot refuses a plot of which it can draw nothing on an axis
/// whose range it is to find.
///
/// @param values  of all curves along the axis; those that are not finite, and on a logarithmic axis
///                those that are not above 0, are not drawn
/// @param about   > 0
std::string range_command(char axis, const std::vector<double>& values, Scale scale, double about);

/// Draws one SVG picture on a white ground, without files, and by no settings of the user's.
///
/// @param script  gnuplot commands, the data in them ("$name << EOD" blocks); terminal and output
///                are set already
/// @throws process::ProcessError  gnuplot is missing or refuses the script, which what() quotes
std::string draw_svg(const std::string& script, int width_px, int height_px);

}  // namespace sonoglide::output
