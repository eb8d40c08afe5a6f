/// Four scenes of a hundred carrier periods from rest, whose values are known to more than 20 digits.
#pragma once

#include <gtest/gtest.h>

#include <cmath>

#include "tests/common/constants/table_1_numbers.hpp"
#include "tests/common/csv/csv.hpp"

namespace sonoglide::tests::open_loop {

/// What a scene has of its own. The rest is Table 1 under a drive of 384 N, sliding at half the
/// peak vibration velocity.
struct Scene {
  const char* name;
  double contact_stiffness_N_per_m;
  double normal_force_N;
  double vibration_sign;  ///< -1: as printed in the paper
};

inline constexpr Scene table_1 = {"table1", Table1::contact_stiffness_N_per_m,
                                  Table1::normal_force_N, 1.0};
inline constexpr Scene stiff_contact = {"stiff_contact", 1e9, Table1::normal_force_N, 1.0};
inline constexpr Scene heavy_friction = {"heavy_friction", 1e9, 2000.0, 1.0};
inline constexpr Scene table_1_as_printed = {"table1_as_printed", Table1::contact_stiffness_N_per_m,
                                             Table1::normal_force_N, -1.0};
inline constexpr Scene scenes[] = {table_1, stiff_contact, heavy_friction, table_1_as_printed};

/// At the end, and means over the whole run and over its second half.
struct Values {
  double displacement_m;
  double velocity_m_per_s;
  double friction_N;
  double friction_ratio;
  double friction_ratio_second_half;
  double dissipation_ratio;
  double dissipation_ratio_second_half;
};

inline Values known(const Scene& scene) {
  const csv::Table table = csv::read_file(REFERENCE_OPEN_LOOP);
  const csv::Row& row = table.row_of("scene", scene.name);
  return {row.number("x_end_m"),    row.number("v_end_m_per_s"), row.number("F_end_N"),
          row.number("rho_all"),    row.number("rho_last"),      row.number("phi_fu_all"),
          row.number("phi_fu_last")};
}

inline void expect_known(const Values& actual, const Scene& scene, double relative) {
  const Values expected = known(scene);
  const auto close = [&](double a, double b) {
    EXPECT_NEAR(a, b, relative * std::abs(b)) << scene.name;
  };
  close(actual.displacement_m, expected.displacement_m);
  close(actual.velocity_m_per_s, expected.velocity_m_per_s);
  close(actual.friction_N, expected.friction_N);
  close(actual.friction_ratio, expected.friction_ratio);
  close(actual.friction_ratio_second_half, expected.friction_ratio_second_half);
  close(actual.dissipation_ratio, expected.dissipation_ratio);
  close(actual.dissipation_ratio_second_half, expected.dissipation_ratio_second_half);
}

}  // namespace sonoglide::tests::open_loop
