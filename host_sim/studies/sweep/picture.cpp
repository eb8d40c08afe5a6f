#include "host_sim/studies/sweep/picture.hpp"

#include "host_sim/output/gnuplot.hpp"
#include "host_sim/studies/sweep/curve.hpp"
#include "host_sim/studies/sweep/curve_family.hpp"
#include "host_sim/studies/sweep/extremes.hpp"
#include "host_sim/studies/sweep/heat_map.hpp"
#include "host_sim/studies/sweep/subject.hpp"

namespace sonoglide::sweep {
namespace {

constexpr int width_px = 900;
constexpr int height_px = 560;

/// @param axes  one or two
std::string script(const Plan& plan, const std::vector<Row>& rows,
                   const std::vector<std::size_t>& axes) {
  if (axes.size() == 1) {
    return curve(plan, rows, axes[0]);
  }
  if (is_heat_map(plan.grid())) {
    return heat_map(plan, rows, axes[0], axes[1]);
  }
  const bool first_by_name = plan.grid().axes()[axes[0]].categorical();
  return first_by_name ? curve_family(plan, rows, axes[1], axes[0])
                       : curve_family(plan, rows, axes[0], axes[1]);
}

}  // namespace

std::vector<std::size_t> drawn_axes(const Grid& grid) {
  std::vector<std::size_t> drawn;
  for (std::size_t axis = 0; axis < grid.axes().size(); ++axis) {
    if (grid.axes()[axis].count > 1) {
      drawn.push_back(axis);
    }
  }
  return drawn;
}

bool is_heat_map(const Grid& grid) {
  const std::vector<std::size_t> drawn = drawn_axes(grid);
  return drawn.size() == 2 &&
         grid.axes()[drawn[0]].categorical() == grid.axes()[drawn[1]].categorical();
}

std::optional<std::string> draw(const Plan& plan, const std::vector<Row>& rows) {
  const std::vector<std::size_t> axes = drawn_axes(plan.grid());
  if (axes.empty() || axes.size() > 2 || !extremes(rows, subject(plan).figure)) {
    return std::nullopt;
  }
  return output::draw_svg(script(plan, rows, axes), width_px, height_px);
}

}  // namespace sonoglide::sweep
