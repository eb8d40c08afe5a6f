#include "tests/host_sim/studies/identify/plant/commissioned/commissioned.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <stdexcept>

#include "host_sim/configure/read/experiment.hpp"
#include "host_sim/loop/run.hpp"
#include "host_sim/report/step_metrics.hpp"
#include "host_sim/studies/identify/plant/study.hpp"
#include "tests/common/dice/dice.hpp"
#include "tests/host_sim/studies/identify/plant/commissioned/recorded.hpp"

namespace sonoglide::identify::plant::test {
namespace {

constexpr std::size_t length = 1024;
constexpr std::size_t before = 32;

std::vector<std::string> with_converter() {
  return {"sensor.adc_bits=12", "run.record=", "run.record_interval_s="};
}

int prompt(const scene::Scene& plant, const configure::ControlDesign& design) {
  report::StepMeter meter(plant, design);
  loop::Watch watch;
  watch.periods.push_back(&meter);
  loop::run(plant, design, watch);
  const std::vector<report::StepMetrics> steps = meter.steps();
  return static_cast<int>(std::count_if(steps.begin(), steps.end(), [](const auto& step) {
    return step.settling_time_s && *step.settling_time_s <= 1e-3;
  }));
}

}  // namespace

configure::Experiment nominal_experiment(const std::string& file) {
  return experiment::read_file(file, with_converter());
}

Commissioned commissioned(const std::string& file, std::uint64_t seed) {
  tests::Dice dice(seed);
  const configure::Experiment nominal = nominal_experiment(file);
  const double contact = nominal.design->contact_stiffness_N_per_m();
  Commissioned result{{dice.between(0.8, 1.2), dice.between(0.7, 1.3), dice.between(0.5, 1.5)},
                      {},
                      {},
                      false,
                      0,
                      0,
                      0};
  const std::array truth = {result.truth[0] * nominal.nominal.plant.stiffness_N_per_m,
                            result.truth[1] * nominal.nominal.friction.coefficient,
                            result.truth[2] * contact};
  std::vector<std::string> driven = with_converter();
  std::vector<std::string> known = with_converter();
  // Of the sensor that the unit has.
  const std::string full_scale =
      fmt::format("sensor.force_full_scale_N={}", nominal.design->scales.force_N);
  driven.push_back(full_scale);
  known.push_back(full_scale);
  for (std::size_t i = 0; i < truth.size(); ++i) {
    driven.push_back(fmt::format("true_values.{}={}", Commissioned::keys[i], truth[i]));
    known.push_back(fmt::format("{}={}", Commissioned::keys[i], truth[i]));
  }
  const configure::Experiment unit = experiment::read_file(file, driven);
  const PlantStudy found =
      study(nominal, recorded(unit, targets(nominal.nominal), length, before), [](double) {});
  for (std::size_t i = 0; i < truth.size(); ++i) {
    const auto& all = found.fit.identification.parameters;
    const auto at = std::find_if(all.begin(), all.end(), [&](const Estimate& each) {
      return each.name == Commissioned::keys[i];
    });
    result.error[i] = at->value / truth[i] - 1.0;
    result.covered[i] = at->low_95 <= truth[i] && truth[i] <= at->high_95;
  }
  result.warned = !found.fit.identification.warnings.empty();
  result.as_designed = prompt(unit.plant, *unit.design);
  result.commissioned =
      prompt(unit.plant, *experiment::read_text(found.scene, "commissioned.toml").design);
  result.exact = prompt(unit.plant, *experiment::read_file(file, known).design);
  return result;
}

std::string columns() {
  return "seed,stiffness,coefficient,contact_stiffness,stiffness_error,coefficient_error,"
         "contact_stiffness_error,covered,warned,prompt_as_designed,prompt_commissioned,prompt_exact\n";
}

std::string row(std::uint64_t seed, const Commissioned& found) {
  return fmt::format("{},{:.6g},{:.6g},{:.6g},{:.2g},{:.2g},{:.2g},{}{}{},{},{},{},{}\n", seed,
                     found.truth[0], found.truth[1], found.truth[2], found.error[0], found.error[1],
                     found.error[2], found.covered[0] ? 1 : 0, found.covered[1] ? 1 : 0,
                     found.covered[2] ? 1 : 0, found.warned ? 1 : 0, found.as_designed,
                     found.commissioned, found.exact);
}

}  // namespace sonoglide::identify::plant::test
