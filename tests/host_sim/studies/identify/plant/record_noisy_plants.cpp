/// Writes noisy_plants.csv: the springs of random plants, as they are found by readings with noise. Arguments: the first
/// seed, the last one, and noises in N.
#include <fmt/format.h>

#include <array>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <string>
#include <vector>

#include "host_sim/configure/read/experiment.hpp"
#include "host_sim/studies/identify/plant/study.hpp"
#include "tests/common/dice/dice.hpp"
#include "tests/host_sim/studies/identify/plant/commissioned/commissioned.hpp"
#include "tests/host_sim/studies/identify/plant/commissioned/recorded.hpp"

namespace sonoglide::identify::plant::test {
namespace {

std::string noisy_row(std::uint64_t seed, const std::string& noise_N) {
  tests::Dice dice(1000 + seed);
  const std::array factors = {dice.between(0.8, 1.2), dice.between(0.7, 1.3),
                              dice.between(0.5, 1.5)};
  std::vector<std::string> settings = {
      "run.record=", "run.record_interval_s=", "sensor.force_noise_N=" + noise_N,
      fmt::format("sensor.seed={}", seed + 1)};
  const configure::Experiment nominal = experiment::read_file(NOISY_SENSOR, settings);
  const std::array truth = {factors[0] * nominal.nominal.plant.stiffness_N_per_m,
                            factors[1] * nominal.nominal.friction.coefficient,
                            factors[2] * nominal.design->contact_stiffness_N_per_m()};
  settings.push_back(fmt::format("sensor.force_full_scale_N={}", nominal.design->scales.force_N));
  for (std::size_t i = 0; i < truth.size(); ++i) {
    settings.push_back(fmt::format("true_values.{}={}", Commissioned::keys[i], truth[i]));
  }
  const configure::Experiment unit = experiment::read_file(NOISY_SENSOR, settings);
  const PlantStudy found =
      study(nominal, recorded(unit, targets(nominal.nominal), 1024, 32), [](double) {});
  const Estimate& spring = found.fit.identification.parameters.front();
  const bool covered = spring.low_95 <= truth[0] && truth[0] <= spring.high_95;
  return fmt::format("{},{},{:.4f},{},{:.5f},{:.5f},{:.5f}\n", noise_N, seed, factors[0],
                     std::isnan(spring.value) ? "open"
                     : covered                ? "1"
                                              : "0",
                     spring.value / truth[0], spring.low_95 / truth[0], spring.high_95 / truth[0]);
}

}  // namespace
}  // namespace sonoglide::identify::plant::test

int main(int argc, char** argv) {
  const std::vector<std::string> arguments(argv + 1, argv + argc);
  if (arguments.size() < 3) {
    return 1;
  }
  std::fputs("force_noise_N,seed,stiffness,covered,value,low,high\n", stdout);
  for (std::uint64_t seed = std::stoul(arguments[0]); seed <= std::stoul(arguments[1]); ++seed) {
    for (std::size_t i = 2; i < arguments.size(); ++i) {
      std::fputs(sonoglide::identify::plant::test::noisy_row(seed, arguments[i]).c_str(), stdout);
      std::fflush(stdout);
    }
  }
  return 0;
}
