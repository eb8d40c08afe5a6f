#include "host_sim/arithmetic/csv.hpp"

#include <fmt/format.h>

#include <cmath>

#include "firmware/control/names.hpp"
#include "host_sim/scene/names.hpp"

namespace sonoglide::arithmetic {
namespace {

std::string number(double value) {
  return std::isfinite(value) ? fmt::format("{:.6g}", value) : std::string();
}

std::string fields(const Precision& precision) {
  return fmt::format("{},{},{},{}", number(precision.rms_difference),
                     number(precision.largest_difference), number(precision.steady_error),
                     number(precision.ripple));
}

std::string fields(const std::optional<loop::StepInstructions>& instructions) {
  return instructions ? fmt::format("{},{},{}", instructions->min, number(instructions->mean),
                                    instructions->max)
                      : std::string(",,");
}

}  // namespace

std::string images_csv(const Comparison& comparison) {
  std::string csv =
      "board,core,arithmetic,rms_difference,largest_difference,steady_error,ripple,fault,"
      "instructions_min,instructions_mean,instructions_max,flash_bytes,ram_bytes\n";
  for (const ImageRow& row : comparison.images) {
    csv += fmt::format("{},{},{},{},{},{},{},{}\n", row.board->name, row.board->core,
                       scene::name_of(scene::arithmetics, row.arithmetic), fields(row.precision),
                       control::name(row.fault), fields(row.image.instructions),
                       row.image.flash_bytes, row.image.ram_bytes);
  }
  return csv;
}

std::string targets_csv(const Comparison& comparison) {
  std::string csv =
      "target,arithmetic,rms_difference,largest_difference,steady_error,ripple,limit,fault\n";
  for (const TargetRow& row : comparison.targets) {
    csv += fmt::format("{:.2f},{},{},{},{}\n", row.target,
                       scene::name_of(scene::arithmetics, row.arithmetic), fields(row.precision),
                       control::name(row.limit), control::name(row.fault));
  }
  return csv;
}

}  // namespace sonoglide::arithmetic
