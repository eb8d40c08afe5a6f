#include "tests/host_sim/studies/work_precision/peers/published/published_problems.hpp"

#include "tests/common/csv/csv.hpp"

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
  const csv::Table table = csv::read_file(REFERENCE_OPEN_LOOP);
  const csv::Row& row = table.row_of("scene", name);
  const long double length = static_cast<long double>(length_m);
  const long double omega = static_cast<long double>(omega_rad_per_s);
  return {row.long_number("x_end_m") / length, row.long_number("v_end_m_per_s") / (length * omega),
          row.long_number("F_end_N") / static_cast<long double>(friction_limit_N(name)),
          row.long_number("rho_all")};
}

}  // namespace sonoglide::peers
