#include "host_sim/studies/stability/report.hpp"

#include <fmt/format.h>

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "host_sim/studies/stability/random_scene.hpp"

namespace sonoglide::stability {
namespace {

using Row = std::vector<std::string>;

std::uint64_t count(const ExtremeRow& row, Verdict verdict) {
  return row.count[static_cast<std::size_t>(verdict)];
}

std::string lead(const StabilityStudy& study) {
  return fmt::format(
      "Every solver over step or tolerance and contact stiffness, and over {} random scenes of "
      "{} carrier periods that span what anybody may ask for. A result is either good, or the "
      "solver declines it and says why, or it is wrong and nothing in it shows: the last kind is "
      "what this page counts.",
      study.extremes.scenes, random_scene_periods);
}

output::Table verdicts() {
  return {"What each verdict means",
          {"Verdict", "Meaning", "What to do"},
          {{"accurate",
            fmt::format("The friction ratio of the whole run is within {:g} of the reference.",
                        accurate_error),
            "Use it."},
           {"bounded but wrong",
            "Finite and |F| <= Fc, yet the friction ratio is off. Nothing in the result shows it.",
            "Shorten the step or tighten the tolerance until the result stops changing, or use "
            "event_taylor."},
           {"|F| > Fc, not reported; not finite, not reported",
            "The result breaks the friction law, or holds no number, and was handed over as good.",
            "A fault of the solver: please report the scene."},
           {"declined: |F| > Fc, step too long for the contact or the oscillator",
            "The solver found the friction force beyond its limit, or saw that it was about to "
            "pass it, and stopped.",
            "Shorten the step to 2.785 Fc/(Kt |V|) or below, or use event_taylor."},
           {"declined: blown up", "The solver found a state that is no number and stopped.",
            "Shorten the step, or use event_taylor; in float32, use float64."},
           {"declined: too many steps",
            "The motion holds a rate so far above the carrier that the step budget of a period "
            "ran out.",
            "Raise the drive frequency or lower the stiffness, or accept the cost of resolving "
            "it."}}};
}

std::string solver_text(const ExtremeRow& row) {
  return fmt::format("{}, {}", row.solver, row.precision);
}

Row extreme_cells(const ExtremeRow& row) {
  return {solver_text(row),
          fmt::format("{:g}", row.setting),
          fmt::format("{}", count(row, Verdict::good)),
          fmt::format("{}", count(row, Verdict::silent_not_finite)),
          fmt::format("{}", count(row, Verdict::silent_friction_bound)),
          fmt::format("{}", count(row, Verdict::wrong)),
          fmt::format("{}", count(row, Verdict::declined_friction_bound) +
                                count(row, Verdict::declined_step_too_long)),
          fmt::format("{}", count(row, Verdict::declined_not_finite)),
          fmt::format("{}", count(row, Verdict::declined_too_many_steps)),
          fmt::format("{}", count(row, Verdict::unsupported))};
}

output::Table extreme_table(const Extremes& extremes) {
  output::Table table{
      fmt::format("Extreme cases: {} random scenes", extremes.scenes),
      {"Solver", "Setting", "Good", "Silent: not finite", "Silent: |F| > Fc", "Silent: energy",
       "Declined: contact", "Declined: blown up", "Declined: steps", "Law refused"},
      {}};
  for (const ExtremeRow& row : extremes.rows) {
    table.rows.push_back(extreme_cells(row));
  }
  return table;
}

output::Table residual_table(const Extremes& extremes) {
  output::Table table{"Balance residual of what was handed over as good",
                      {"Solver", "Median", "90 %", "99 %", "99.9 %", "Largest"},
                      {}};
  for (const ExtremeRow& row : extremes.rows) {
    Row cells = {solver_text(row)};
    for (const double residual : row.residual) {
      cells.push_back(fmt::format("{:.1e}", residual));
    }
    table.rows.push_back(cells);
  }
  return table;
}

std::string map_text(const StabilityMaps& maps) {
  return fmt::format(
      "The paper's Table 1 at 384 N, sliding at half the peak vibration velocity, {} carrier "
      "periods from rest, compared with event_taylor of order 16 at tolerance 1e-12 (which order "
      "12 at 1e-13 confirms within {:.1e}). Green is accurate; orange, pink and black are "
      "results that are wrong without a word; blue, yellow and grey were declined. The dashed line "
      "is "
      "where classical Runge–Kutta becomes unstable in a full slide.",
      maps.grid.periods, maps.reference_difference);
}

std::string extremes_text() {
  return fmt::format(
      "The balance residual compares the change of stored energy with the works of drive, damper "
      "and contact, relative to the largest energy that passed through the run: the sum over the "
      "steps of the magnitude of one of those works, or the largest energy stored. Good means at "
      "most {:g} in float64 and {:g} in float32. A solver may take {} steps per "
      "period. extremes_worst.csv lists the worst scenes of each solver with all their numbers.",
      allowed_residual_float64, allowed_residual_float32, extreme_step_limit);
}

}  // namespace

output::Page study_page(const StabilityStudy& study, const MapPictures& pictures) {
  output::Page page;
  page.title = "Where each solver can be trusted";
  page.lead = lead(study);
  page.tables = {verdicts(), extreme_table(study.extremes), residual_table(study.extremes)};
  page.sections = {{"Maps over setting and contact stiffness",
                    map_text(study.maps),
                    {},
                    {{"float64", "", pictures.float64}, {"float32", "", pictures.float32}}},
                   {"How the extreme cases are counted", extremes_text(), {}, {}}};
  return page;
}

}  // namespace sonoglide::stability
