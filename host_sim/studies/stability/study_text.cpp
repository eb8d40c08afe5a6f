#include "host_sim/studies/stability/study_text.hpp"

#include <fmt/format.h>

#include <cstddef>
#include <initializer_list>

namespace sonoglide::stability {
namespace {

std::uint64_t sum(const ExtremeRow& row, std::initializer_list<Verdict> verdicts) {
  std::uint64_t total = 0;
  for (const Verdict verdict : verdicts) {
    total += row.count[static_cast<std::size_t>(verdict)];
  }
  return total;
}

}  // namespace

std::string study_text(const Extremes& extremes) {
  std::string text =
      fmt::format("{} random scenes\n{:<24} {:>8} {:>9} {:>14} {:>12}\n", extremes.scenes, "",
                  "good", "declined", "silent: bound", "energy");
  for (const ExtremeRow& row : extremes.rows) {
    text += fmt::format("{:<16} {:<7} {:>8} {:>9} {:>14} {:>12}\n", row.solver, row.precision,
                        sum(row, {Verdict::good}),
                        sum(row, {Verdict::declined_friction_bound, Verdict::declined_step_too_long,
                                  Verdict::declined_not_finite, Verdict::declined_too_many_steps}),
                        sum(row, {Verdict::silent_friction_bound, Verdict::silent_not_finite}),
                        sum(row, {Verdict::wrong}));
  }
  return text;
}

}  // namespace sonoglide::stability
