#include "tests/host_sim/studies/work_precision/peers/published/published_problems.hpp"

#include <fstream>
#include <sstream>
#include <stdexcept>

#include "tests/common/constants/table_1_numbers.hpp"

namespace sonoglide::peers {
namespace {

using tests::Table1;

constexpr double omega_rad_per_s = Table1::carrier_rad_per_s;
constexpr double drive_N = 384.0;
/// The length scale is that of a free mass under the drive.
constexpr double inertia_N_per_m = Table1::inertia_N_per_m;
constexpr double length_m = drive_N / inertia_N_per_m;

double friction_limit_N(const std::string& name) {
  const double normal_N = name == "heavy_friction" ? 2000.0 : Table1::normal_force_N;
  return Table1::friction_coefficient * normal_N;
}

}  // namespace

std::vector<std::string> published_names() {
  return {"table1", "stiff_contact", "heavy_friction", "table1_as_printed"};
}

Problem published_problem(const std::string& name) {
  const bool table_1 = name.rfind("table1", 0) == 0;
  const double contact_N_per_m = table_1 ? Table1::contact_stiffness_N_per_m : 1e9;
  const double limit_N = friction_limit_N(name);
  Problem problem{};
  problem.stiffness = Table1::stiffness_N_per_m / inertia_N_per_m;
  problem.friction_force = limit_N / drive_N;
  problem.contact_stiffness = contact_N_per_m * length_m / limit_N;
  problem.vibration_sign = name == "table1_as_printed" ? -1.0 : 1.0;
  problem.drive_amplitude = 1.0;
  problem.sliding_velocity = 0.5 / (1.0 - problem.stiffness);
  problem.periods = 100;
  return problem;
}

PublishedOutcome published_outcome(const std::string& name) {
  std::ifstream file(REFERENCE_OPEN_LOOP);
  for (std::string line; std::getline(file, line);) {
    std::istringstream fields(line);
    std::string text;
    std::getline(fields, text, ',');
    if (text != name) {
      continue;
    }
    long double numbers[4]{};
    for (long double& number : numbers) {
      std::getline(fields, text, ',');
      number = std::stold(text);
    }
    const long double length = static_cast<long double>(length_m);
    const long double omega = static_cast<long double>(omega_rad_per_s);
    return {numbers[0] / length, numbers[1] / (length * omega),
            numbers[2] / static_cast<long double>(friction_limit_N(name)), numbers[3]};
  }
  throw std::runtime_error(name + " is not in " REFERENCE_OPEN_LOOP);
}

}  // namespace sonoglide::peers
