#include "host_sim/studies/identify/friction/candidate.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

#include "firmware/friction/coulomb_friction_ratio.hpp"
#include "firmware/friction/dahl_friction_ratio.hpp"
#include "firmware/friction/iwan_friction_ratio.hpp"
#include "firmware/friction/lugre_friction_ratio.hpp"
#include "firmware/friction/normal_vibration_ratio.hpp"
#include "firmware/friction/stribeck_friction_ratio.hpp"
#include "firmware/friction/transverse_vibration_ratio.hpp"
#include "firmware/numeric/turn.hpp"

namespace sonoglide::identify::friction {

namespace core = sonoglide::friction;

double length_of(const Reading& row) {
  return row.frequency_Hz > 0.0 ? row.vibration_m_per_s / (numeric::two_pi * row.frequency_Hz)
                                : row.vibration_m_per_s;
}

Extent extent_of(const Readings& readings) {
  Extent extent{0.0, 0.0, readings.have_frequency};
  for (const Reading& row : readings.rows) {
    extent.largest_length = std::max(extent.largest_length, length_of(row));
    extent.fastest_m_per_s =
        std::max(extent.fastest_m_per_s, row.sliding_m_per_s + row.vibration_m_per_s);
  }
  return extent;
}

namespace {

using Values = std::vector<double>;

bool vibrates(const Reading& row) {
  return row.vibration_m_per_s > 0.0;
}

MeanFriction coulomb(const Candidate& /*self*/, const Reading& row, const Values& /*values*/) {
  return {vibrates(row) ? core::coulomb_friction_ratio(row.velocity_ratio()) : 1.0, 1.0};
}

MeanFriction transverse(const Candidate& /*self*/, const Reading& row, const Values& /*values*/) {
  return {vibrates(row) ? core::transverse_vibration_ratio(row.velocity_ratio()) : 1.0, 1.0};
}

MeanFriction dahl(const Candidate& /*self*/, const Reading& row, const Values& values) {
  return {vibrates(row)
              ? core::dahl_friction_ratio(row.velocity_ratio(), values[0] * length_of(row))
              : 1.0,
          1.0};
}

MeanFriction iwan(const Candidate& self, const Reading& row, const Values& values) {
  return {vibrates(row)
              ? core::iwan_friction_ratio(row.velocity_ratio(), values[0] * length_of(row),
                                          static_cast<std::size_t>(self.elements))
              : 1.0,
          1.0};
}

MeanFriction normal(const Candidate& /*self*/, const Reading& row, const Values& values) {
  if (!vibrates(row)) {
    return {1.0, 1.0};
  }
  const double amplitude = std::min(values[0] * length_of(row), 1.0);
  return {core::normal_vibration_ratio(amplitude, row.velocity_ratio() / values[1]), 1.0};
}

/// values: the drop d and the velocity vm of least friction. Of μ/μs = sgn V - a V + b V³ they are
/// a = 3/2 d/vm and b = 1/2 d/vm³.
MeanFriction stribeck(const Candidate& /*self*/, const Reading& row, const Values& values) {
  const auto curve = [&](double velocity) {
    const double part = velocity / values[1];
    return 1.0 - 0.5 * values[0] * part * (3.0 - part * part);
  };
  const double undriven = curve(row.sliding_m_per_s);
  if (!vibrates(row)) {
    return {undriven, undriven};
  }
  const double vibration = row.vibration_m_per_s / values[1];
  return {core::stribeck_friction_ratio(row.velocity_ratio(), 1.5 * values[0] * vibration,
                                        0.5 * values[0] * vibration * vibration * vibration),
          undriven};
}

/// values: σ0/Fc, Fs/Fc - 1, the Stribeck velocity and σ2/Fc.
MeanFriction lugre(const Candidate& /*self*/, const Reading& row, const Values& values) {
  const double vibration = vibrates(row) ? row.vibration_m_per_s : row.sliding_m_per_s;
  const core::LuGreShape contact{values[0] * length_of(row), 1.0 + values[1], values[2] / vibration,
                                 values[3] * vibration};
  const double r = row.sliding_m_per_s / vibration;
  const double undriven = contact.undriven(r);
  return {vibrates(row) ? core::lugre_mean_friction(r, contact) : undriven, undriven};
}

/// Of a law whose ranges end short of a contact that sticks and of Coulomb's.
constexpr double end_of_range = 5e-4;

/// Kt/Fc, or Kt/(w Fc) where the frequency is not known.
ShapeParameter stiffness(const Extent& extent) {
  return {extent.have_frequency ? "contact_stiffness_per_friction_limit_per_m"
                                : "dahl_number_per_vibration_velocity_s_per_m",
          1e-3 / extent.largest_length,
          1e4 / extent.largest_length,
          "the contact hardly slips: only its softness shows, not how soft it is",
          "a contact as stiff as Coulomb's fits as well",
          0.0,
          "dahl_number_at_largest_vibration",
          extent.largest_length};
}

Candidate lugre_candidate(const Extent& extent) {
  return {"lugre",
          "LuGre",
          "along",
          0,
          {stiffness(extent),
           {"static_over_sliding_friction", 1e-4, 10.0,
            "static friction is no more than sliding friction",
            "a static friction of eleven times the sliding one or more", 1.0},
           {"stribeck_velocity_m_per_s", 1e-3 * extent.fastest_m_per_s,
            10.0 * extent.fastest_m_per_s, "static friction falls at once",
            "static friction falls beyond the speeds that were measured"},
           {"viscous_friction_per_friction_limit_s_per_m", 1e-4 / extent.fastest_m_per_s,
            10.0 / extent.fastest_m_per_s, "no viscous friction is significant",
            "friction is viscous alone"}},
          lugre,
          3e-3};
}

Candidate normal_candidate(const Extent& extent) {
  return {"normal_coulomb",
          "Coulomb with springs",
          "normal",
          0,
          {{extent.have_frequency ? "normal_stiffness_per_normal_force_per_m"
                                  : "amplitude_ratio_per_vibration_velocity_s_per_m",
            1e-3 / extent.largest_length, 1.0 / extent.largest_length,
            "the normal force hardly vibrates",
            "the contact is about to open at the largest vibration; beyond, the law has no closed "
            "form",
            0.0, "amplitude_ratio_at_largest_vibration", extent.largest_length},
           {"critical_velocity_per_vibration_velocity", 1e-3, 1e3,
            "every row is beyond the critical velocity", "no row is near the critical velocity"}},
          normal};
}

Candidate stribeck_candidate(const Extent& extent) {
  return {"stribeck",
          "Stribeck",
          "along",
          0,
          {{"friction_drop", 1e-4, 1.0, "friction does not fall with the speed",
            "friction falls to nothing, as far as a passive contact may"},
           {"least_friction_velocity_m_per_s", 1e-2 * extent.fastest_m_per_s,
            1e2 * extent.fastest_m_per_s, "friction is least at a speed far below those measured",
            "friction is least at a speed far beyond those measured"}},
          stribeck,
          end_of_range};
}

}  // namespace

std::vector<Candidate> candidates(const Extent& extent) {
  return {{"coulomb", "Coulomb", "along", 0, {}, coulomb},
          {"dahl", "Dahl", "along", 0, {stiffness(extent)}, dahl, end_of_range},
          {"iwan", "Iwan, 1 spring", "along", 1, {stiffness(extent)}, iwan, end_of_range},
          {"iwan", "Iwan, 8 springs", "along", 8, {stiffness(extent)}, iwan, end_of_range},
          stribeck_candidate(extent),
          lugre_candidate(extent),
          {"transverse_coulomb", "Coulomb across", "across", 0, {}, transverse},
          normal_candidate(extent)};
}

std::string check_law(const std::string& law) {
  return std::find(fitted_laws.begin(), fitted_laws.end(), law) != fitted_laws.end()
             ? std::string()
             : fmt::format("\"{}\" is no law that can be fitted; allowed: {}", law,
                           fmt::join(fitted_laws, ", "));
}

}  // namespace sonoglide::identify::friction
