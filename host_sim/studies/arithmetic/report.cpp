#include "host_sim/studies/arithmetic/report.hpp"

#include <fmt/format.h>

#include "firmware/control/interface/names.hpp"
#include "host_sim/output/number.hpp"
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

std::string images_csv(const ArithmeticComparison& comparison) {
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

std::string targets_csv(const ArithmeticComparison& comparison) {
  std::string csv =
      "target,arithmetic,rms_difference,largest_difference,steady_error,ripple,limit,fault\n";
  for (const TargetRow& row : comparison.targets) {
    csv += fmt::format("{:.2f},{},{},{},{}\n", row.target,
                       scene::name_of(scene::arithmetics, row.arithmetic), fields(row.precision),
                       control::name(row.limit), control::name(row.fault));
  }
  return csv;
}

namespace {

std::string number(double value) {
  return output::formatted(value, "{:.1e}");
}

std::string instructions(const std::optional<loop::ImageInstructions>& count) {
  return count ? fmt::format("{}/{:.0f}/{}", count->step.min, count->step.mean, count->step.max)
               : std::string("-");
}

std::string line(const ImageRow& row) {
  const std::string fault =
      row.fault == control::Fault::none ? "" : fmt::format("  FAULT: {}", control::name(row.fault));
  return fmt::format("{:11} {:8} {:>8} {:>8} {:>8} {:>8} {:>17} {:>7}{}\n", row.board->core,
                     scene::name_of(scene::arithmetics, row.arithmetic),
                     number(row.precision.rms_difference), number(row.precision.largest_difference),
                     number(row.precision.steady_error), number(row.precision.ripple),
                     instructions(row.image.instructions), row.image.flash_bytes, fault);
}

std::string text(const ArithmeticComparison& comparison) {
  std::string lines = fmt::format("{:11} {:8} {:>8} {:>8} {:>8} {:>8} {:>17} {:>7}\n", "core", "",
                                  "rms", "largest", "error", "ripple", "instructions", "flash");
  for (const ImageRow& row : comparison.images) {
    lines += line(row);
  }
  return lines +
         "rms, largest: difference of the friction ratio from float64's; instructions of a step: "
         "min/mean/max\n";
}

}  // namespace

output::StudyReport report(const scene::Scene& scene, const ArithmeticComparison& comparison) {
  return {
      {{"arithmetic.csv", images_csv(comparison)},
       {"targets.csv", targets_csv(comparison)},
       {"arithmetic.svg", draw(comparison, scene.name + ", the controller in every arithmetic")}},
      text(comparison)};
}

}  // namespace sonoglide::arithmetic
