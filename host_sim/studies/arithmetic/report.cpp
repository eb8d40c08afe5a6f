#include "host_sim/studies/arithmetic/report.hpp"

#include <fmt/format.h>

#include <cmath>

#include "firmware/control/names.hpp"
#include "host_sim/output/output_folder.hpp"
#include "host_sim/scene/names.hpp"
#include "host_sim/studies/arithmetic/csv.hpp"
#include "host_sim/studies/arithmetic/picture.hpp"
#include "host_sim/text/printable.hpp"

namespace sonoglide::arithmetic {
namespace {

std::string number(double value) {
  return std::isfinite(value) ? fmt::format("{:.1e}", value) : std::string("-");
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

}  // namespace

void write(const std::filesystem::path& out, const scene::Scene& scene,
           const Comparison& comparison) {
  const std::string svg = draw(comparison, scene.name + ", the controller in every arithmetic");
  output::OutputFolder folder(out);
  folder.write("arithmetic.csv", images_csv(comparison));
  folder.write("targets.csv", targets_csv(comparison));
  folder.write("arithmetic.svg", svg);
  folder.commit();
}

std::string text(const Comparison& comparison, const std::filesystem::path& out) {
  std::string lines = fmt::format("{:11} {:8} {:>8} {:>8} {:>8} {:>8} {:>17} {:>7}\n", "core", "",
                                  "rms", "largest", "error", "ripple", "instructions", "flash");
  for (const ImageRow& row : comparison.images) {
    lines += line(row);
  }
  return lines + fmt::format(
                     "rms, largest: difference of the friction ratio from float64's; instructions "
                     "of a step: min/mean/max\npicture: {}\n",
                     text::printable((out / "arithmetic.svg").string()));
}

}  // namespace sonoglide::arithmetic
