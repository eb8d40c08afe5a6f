#include "host_sim/sweep/picture.hpp"

#include "host_sim/plot/gnuplot.hpp"
#include "host_sim/sweep/curve.hpp"
#include "host_sim/sweep/extremes.hpp"
#include "host_sim/sweep/heat_map.hpp"
#include "host_sim/sweep/subject.hpp"

namespace sonoglide::sweep {
namespace {

constexpr int width_px = 900;
constexpr int height_px = 560;

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

std::optional<std::string> draw(const Plan& plan, const std::vector<Row>& rows) {
  const std::vector<std::size_t> axes = drawn_axes(plan.grid());
  if (axes.empty() || axes.size() > 2 || !extremes(rows, subject(plan).figure)) {
    return std::nullopt;
  }
  const std::string script =
      axes.size() == 1 ? curve(plan, rows, axes[0]) : heat_map(plan, rows, axes[0], axes[1]);
  return plot::draw_svg(script, width_px, height_px);
}

}  // namespace sonoglide::sweep
