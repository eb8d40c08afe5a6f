/// How the targets of a scene are told in the header of its controller.
#pragma once

#include <fmt/format.h>

#include <cstdint>
#include <string>
#include <utility>

#include "host_sim/boards/emulated/initialiser.hpp"
#include "host_sim/configure/configuration_error.hpp"
#include "host_sim/configure/control_design.hpp"
#include "host_sim/configure/controller_parameters.hpp"
#include "host_sim/loop/control_run.hpp"
#include "host_sim/loop/plant/carrier_grid.hpp"
#include "host_sim/scene/bound.hpp"
#include "host_sim/scene/scene.hpp"

namespace sonoglide::emulated {

/// @throws configure::ConfigurationError  an image cannot count so far
inline void require_reach(const scene::Scene& scene, const loop::ScheduledTarget& step,
                          double step_period_s) {
  constexpr std::uint64_t most_steps = 0xffffffff;
  if (step.place > most_steps) {
    throw configure::ConfigurationError(
        fmt::format("controller.{}", scene.controller->target_key()),
        fmt::format("a step at {:g} s is out of an image's reach; allowed: at most {} s",
                    step.time_s, scene::at_most(static_cast<double>(most_steps) * step_period_s)));
  }
}

template <class Scalar>
std::string target_steps(const scene::Scene& scene, const configure::ControlDesign& design) {
  const char* const unit = design.holds_force ? " N" : "";
  const loop::CarrierGrid grid(scene);
  std::string text;
  for (const loop::ScheduledTarget& step : loop::target_schedule(scene, grid)) {
    if (design.resonance() == nullptr) {
      require_reach(scene, step, scene.controller->every_periods * grid.period_s());
    }
    text += fmt::format("    {{{}, {}}},  // {}{}\n", step.place,
                        Initialiser<Scalar>::of(configure::target_of<Scalar>(design, step.target)),
                        step.target, unit);
  }
  return text;
}

/// How an image follows its targets.
struct TargetText {
  const char* header;
  std::string lines;
  const char* drive;  ///< of which the carrier period is
};

/// Of a resonant loop; `where` among the numbers above the word of the start is.
inline std::string frequency_step(const configure::ResonantDesign* resonance, const char* where) {
  return resonance == nullptr
             ? ""
             : fmt::format(
                   "\n/// The frequency of a command is this step times the word of the start, which is "
                   "the {} "
                   "number\n/// above, and the command's steps together.\n"
                   "inline constexpr double frequency_step_Hz = {:a};\n",
                   where, resonance->step_Hz);
}

template <class Scalar>
TargetText texture_text(double period_m, const configure::ControlDesign& design) {
  const configure::TextureDesign& texture = *design.texture;
  const configure::ResonantDesign* const resonance = design.resonance();
  std::string points;
  for (const double value : texture.values) {
    points += fmt::format("    {},  // {}{}\n",
                          Initialiser<Scalar>::of(configure::target_of<Scalar>(design, value)),
                          value, design.holds_force ? " N" : "");
  }
  const std::string steps =
      resonance == nullptr
          ? fmt::format("EqualSteps, TexturePeriod> target_steps = {{\n    {{{}}}", texture.weight)
          : fmt::format("WordedSteps, TexturePeriod> target_steps = {{\n    {{{}, {}}}",
                        texture.weight, resonance->start_word);
  return {"firmware/app/texture.hpp",
          fmt::format("struct TexturePeriod {{\n  static constexpr double period_m = {:a};\n}};\n"
                      "inline constexpr Scalar texture_points[] = {{\n{}}};\n"
                      "inline constexpr TextureTargets<Scalar, {},\n    {{{}, {}U, {}U}},\n"
                      "    texture_points, {}}};\n{}",
                      period_m, points, steps, texture.period, texture.inverse, texture.lead,
                      texture.values.size(), frequency_step(resonance, "second")),
          resonance == nullptr ? "" : " at the start"};
}

/// In a resonant loop with the word of the start and the step of the frequency.
template <class Scalar>
TargetText target_text(const scene::Scene& scene, const configure::ControlDesign& design) {
  if (design.texture) {
    return texture_text<Scalar>(scene.controller->texture->period_m, design);
  }
  const configure::ResonantDesign* const resonance = design.resonance();
  const std::string steps = target_steps<Scalar>(scene, design);
  if (resonance == nullptr) {
    return {"firmware/app/target_schedule.hpp",
            fmt::format("inline constexpr TargetStep<Scalar> target_steps[] = {{\n{}}};\n", steps),
            ""};
  }
  std::string lines =
      fmt::format("inline constexpr TimedTargets<Scalar, {}> target_steps = {{{}, {{\n{}}}}};\n{}",
                  scene.controller->targets().size(), resonance->start_word, steps,
                  frequency_step(resonance, "first"));
  return {"firmware/app/timed_targets.hpp", std::move(lines), " at the start"};
}

}  // namespace sonoglide::emulated
