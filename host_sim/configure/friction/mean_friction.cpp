#include "host_sim/configure/friction/mean_friction.hpp"

#include <cstddef>
#include <limits>
#include <variant>

#include "firmware/friction/coulomb_friction_ratio.hpp"
#include "firmware/friction/dahl_friction_ratio.hpp"
#include "firmware/friction/iwan_friction_ratio.hpp"
#include "firmware/friction/lugre_friction_ratio.hpp"
#include "firmware/friction/normal_vibration_ratio.hpp"
#include "firmware/friction/stribeck_friction_ratio.hpp"
#include "firmware/friction/transverse_vibration_ratio.hpp"

namespace sonoglide::configure {
namespace {

namespace laws = scene::laws;

/// Mean friction over μN, by law.
struct MeanFriction {
  const scene::Friction& contact;
  double carrier_rad_per_s;
  double sliding_m_per_s;
  double vibration_m_per_s;

  double operator()(const laws::None& /*law*/) const { return 1.0; }
  double operator()(const laws::Coulomb& /*law*/) const {
    return friction::coulomb_friction_ratio(velocity_ratio());
  }
  double operator()(const laws::Dahl& /*law*/) const {
    return friction::dahl_friction_ratio(velocity_ratio(), contact_number());
  }
  double operator()(const laws::Iwan& law) const {
    return friction::iwan_friction_ratio(velocity_ratio(), contact_number(),
                                         static_cast<std::size_t>(law.elements));
  }
  double operator()(const laws::LuGre& law) const {
    const friction::LuGreShape shape{
        contact_number(), law.static_coefficient / contact.coefficient,
        law.stribeck_velocity_m_per_s / vibration_m_per_s,
        law.viscous_friction_N_s_per_m * vibration_m_per_s / contact.limit_N()};
    return friction::lugre_mean_friction(velocity_ratio(), shape);
  }
  double operator()(const laws::Stribeck& law) const {
    const double v = vibration_m_per_s;
    return friction::stribeck_friction_ratio(velocity_ratio(),
                                             law.fall_s_per_m * v / contact.coefficient,
                                             law.rise_s3_per_m3 * v * v * v / contact.coefficient);
  }
  double operator()(const laws::TransverseCoulomb& /*law*/) const {
    return friction::transverse_vibration_ratio(velocity_ratio());
  }
  double operator()(const laws::NormalCoulomb& law) const {
    const double critical_part = contact.coefficient * law.normal_contact_stiffness_N_per_m /
                                 contact.contact_stiffness_N_per_m;
    return friction::normal_vibration_ratio(
        law.normal_contact_stiffness_N_per_m * amplitude_m() / contact.normal_force_N,
        velocity_ratio() / critical_part);
  }

 private:
  double velocity_ratio() const { return sliding_m_per_s / vibration_m_per_s; }
  double amplitude_m() const { return vibration_m_per_s / carrier_rad_per_s; }
  double contact_number() const {
    return contact.contact_stiffness_N_per_m * amplitude_m() / contact.limit_N();
  }
};

}  // namespace

double mean_friction_ratio(const scene::Friction& contact, double carrier_rad_per_s,
                           double sliding_m_per_s, double vibration_m_per_s) {
  return std::visit(MeanFriction{contact, carrier_rad_per_s, sliding_m_per_s, vibration_m_per_s},
                    contact.law) *
         contact.limit_N() / scene::undriven_friction_N(contact.law, contact, sliding_m_per_s);
}

VibrationRange vibration_range(const scene::Friction& contact, double carrier_rad_per_s,
                               double sliding_m_per_s) {
  constexpr double least = 1e-3;
  constexpr double least_of_opening = 1e-6;
  if (const auto* law = std::get_if<laws::NormalCoulomb>(&contact.law)) {
    const double opening_m_per_s =
        carrier_rad_per_s * contact.normal_force_N / law->normal_contact_stiffness_N_per_m;
    return {least_of_opening * opening_m_per_s, opening_m_per_s};
  }
  return {least * sliding_m_per_s, std::numeric_limits<double>::infinity()};
}

}  // namespace sonoglide::configure
