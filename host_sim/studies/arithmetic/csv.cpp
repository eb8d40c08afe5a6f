#include "host_sim/studies/arithmetic/csv.hpp"

#include <fmt/format.h>

#include "firmware/control/names.hpp"
#include "host_sim/output/csv_number.hpp"
#include "host_sim/scene/names.hpp"

namespace sonoglide::arithmetic {
namespace {

std::string cell(double value) {
  constexpr int digits = 6;
  return output::csv_number(value, digits);
}

std::string fields(const Precision& precision) {
  return fmt::format("{},{},{},{}", cell(precision.rms_difference),
                     cell(precision.largest_difference), cell(precision.steady_error),
                     cell(precision.ripple));
}

std::string fields(const std::optional<loop::ImageInstructions>& instructions) {
  return instructions ? fmt::format("{},{},{}", instructions->step.min,
                                    cell(instructions->step.mean), instructions->step.max)
                      : std::string("nan,nan,nan");
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
