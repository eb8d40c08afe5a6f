/// What a sweep shows: its table, its picture and its page.
#pragma once

#include <cstddef>
#include <optional>
#include <ostream>
#include <string>
#include <vector>

#include "host_sim/output/page.hpp"
#include "host_sim/studies/sweep/plan.hpp"
#include "host_sim/studies/sweep/row.hpp"

namespace sonoglide::sweep {

// What the pictures of a sweep show.

struct Subject {
  double PointResult::*figure;
  std::string title;
  std::string label;  ///< with its unit
};

/// The friction ratio over the window, or where a load ends; in closed loop the steady error of the last target step, or the
/// amplitude of a texture.
Subject subject(const Plan& plan);

struct ExtremePoints {
  std::size_t lowest;   ///< point
  std::size_t highest;  ///< point
};

/// The first point of several with the same value; absent where the figure is NaN in every row.
std::optional<ExtremePoints> extremes(const std::vector<PointResult>& rows,
                                      double PointResult::*figure);

/// One line for each point, in the order of the grid, under a heading: the varied keys, the figures
/// of Row, status last. With a load also where and how fast it ends. In closed loop also settling_time_s, steady_error, ripple and limit, or those of a
/// texture, and fault.
/// Numbers read back the same to the bit; what is not defined is `nan`. A status with a comma is
/// quoted (RFC 4180).
void write_csv(std::ostream& out, const Plan& plan, const std::vector<PointResult>& rows);
void write_heading(std::ostream& out, const Plan& plan);
void write_row(std::ostream& out, const Plan& plan, std::size_t point, const PointResult& row);

/// The axes with more than one value.
std::vector<std::size_t> drawn_axes(const Grid& grid);

/// Whether the picture is a heat map: two axes drawn, both on a scale or both by name.
bool is_heat_map(const Grid& grid);

/// One axis drawn: a curve; two: a heat map, the first one upwards, or, where one of them is by
/// name, a curve for each name. Absent for any other number of axes, and where no point has a value.
std::optional<output::Sheet> picture(const Plan& plan, const std::vector<PointResult>& rows);

/// @param picture  of the same rows
output::Page sweep_page(const Plan& plan, const std::vector<PointResult>& rows,
                        const std::optional<output::Sheet>& picture);

/// Along an axis a heat map shows at most this many values, evenly picked.
inline constexpr std::size_t most_cells_along = 200;

}  // namespace sonoglide::sweep
