/// Mean friction of contacts that are followed in short steps under a prescribed vibration, in SI units:
/// written from the literature, apart from firmware/friction.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <variant>

#include "host_sim/scene/scene.hpp"
#include "tests/common/constants/pi.hpp"

namespace sonoglide::tests {

/// A sliding velocity with a sinusoidal vibration.
struct Vibration {
  double sliding_m_per_s;
  double peak_m_per_s;
  double rad_per_s;
};

/// Mean friction force along the sliding over one period, once it repeats itself [N].
class FollowedFriction {
 public:
  FollowedFriction(const scene::Friction& contact, const Vibration& vibration)
      : contact_(contact), vibration_(vibration) {}

  double operator()(const scene::laws::None& /*law*/) const { return 0.0; }
  double operator()(const scene::laws::Coulomb& /*law*/) const {
    return contact_.limit_N() * mean([&](double angle) { return std::copysign(1.0, slip(angle)); });
  }
  double operator()(const scene::laws::Dahl& /*law*/) const {
    return bristles([&](double /*slip*/) { return contact_.limit_N(); }, 0.0);
  }
  double operator()(const scene::laws::LuGre& law) const {
    const double excess = law.static_coefficient - contact_.coefficient;
    return bristles(
        [&](double slip) {
          const double part = slip / law.stribeck_velocity_m_per_s;
          return contact_.normal_force_N * (contact_.coefficient + excess * std::exp(-part * part));
        },
        law.viscous_friction_N_s_per_m);
  }
  double operator()(const scene::laws::Iwan& law) const {
    const auto count = static_cast<std::size_t>(law.elements);
    const double stiffness = contact_.contact_stiffness_N_per_m / law.elements;
    std::array<double, 8> force{};
    const double travel = vibration_.sliding_m_per_s * two_pi / vibration_.rad_per_s;
    const int periods =
        3 + static_cast<int>(2.0 * contact_.limit_N() / (stiffness * travel * law.elements));
    double sum = 0.0;
    for (int step = 0; step < periods * steps; ++step) {
      sum = step % steps == 0 ? 0.0 : sum;
      const double moved = slip(angle_at(step)) * step_s();
      for (std::size_t i = 0; i < count; ++i) {
        const double limit = contact_.limit_N() * (2.0 * static_cast<double>(i) + 1.0) /
                             static_cast<double>(count * count);
        const double before = force[i];
        force[i] = std::clamp(force[i] + stiffness * moved, -limit, limit);
        sum += 0.5 * (before + force[i]);
      }
    }
    return sum / steps;
  }
  double operator()(const scene::laws::Stribeck& law) const {
    return contact_.normal_force_N * mean([&](double angle) {
             const double v = slip(angle);
             return std::copysign(contact_.coefficient, v) - law.fall_s_per_m * v +
                    law.rise_s3_per_m3 * v * v * v;
           });
  }
  double operator()(const scene::laws::TransverseCoulomb& /*law*/) const {
    return contact_.limit_N() * mean([&](double angle) {
             const double across = vibration_.peak_m_per_s * std::cos(angle);
             return vibration_.sliding_m_per_s / std::hypot(vibration_.sliding_m_per_s, across);
           });
  }
  double operator()(const scene::laws::NormalCoulomb& law) const {
    const double amplitude_m = vibration_.peak_m_per_s / vibration_.rad_per_s;
    const auto limit_N = [&](double angle) {
      return contact_.coefficient *
             std::max(0.0, contact_.normal_force_N + law.normal_contact_stiffness_N_per_m *
                                                         amplitude_m * std::cos(angle));
    };
    const double pull = contact_.contact_stiffness_N_per_m * vibration_.sliding_m_per_s * step_s();
    double force = limit_N(0.5 * two_pi);
    double sum = 0.0;
    for (int step = 0; step < 2 * steps; ++step) {
      sum = step % steps == 0 ? 0.0 : sum;
      force = std::min(force + pull, limit_N(angle_at(step)));
      sum += force;
    }
    return sum / steps;
  }

 private:
  static constexpr int steps = 2000;

  static double angle_at(int step) { return two_pi * (step + 0.5) / steps; }
  double step_s() const { return two_pi / vibration_.rad_per_s / steps; }
  double slip(double angle) const {
    return vibration_.sliding_m_per_s + vibration_.peak_m_per_s * std::cos(angle);
  }

  template <class Function>
  static double mean(const Function& function) {
    double sum = 0.0;
    for (int step = 0; step < steps; ++step) {
      sum += function(angle_at(step));
    }
    return sum / steps;
  }

  /// dF/dt = K (V - |V| F/g(V)), linear in F: two passes from 0 tell where a period returns to.
  template <class Curve>
  double bristles(const Curve& curve_N, double viscous_N_s_per_m) const {
    double begin = 0.0;
    double sum = 0.0;
    for (int pass = 0; pass < 2; ++pass) {
      double force = begin;
      double left = 1.0;
      sum = 0.0;
      for (int step = 0; step < steps; ++step) {
        const double v = slip(angle_at(step));
        const double level = std::copysign(curve_N(v), v);
        const double decay =
            contact_.contact_stiffness_N_per_m * std::abs(v) * step_s() / std::abs(level);
        const double share = decay > 1e-12 ? -std::expm1(-decay) / decay : 1.0;
        sum += level + (force - level) * share;
        force = level + (force - level) * std::exp(-decay);
        left *= std::exp(-decay);
      }
      begin = pass == 0 ? force / (1.0 - left) : begin;
    }
    return sum / steps + viscous_N_s_per_m * vibration_.sliding_m_per_s;
  }

  const scene::Friction& contact_;
  Vibration vibration_;
};

/// Over the friction of the same sliding without vibration.
inline double followed_ratio(const scene::Friction& contact, const Vibration& vibration) {
  return std::visit(FollowedFriction(contact, vibration), contact.law) /
         scene::undriven_friction_N(contact.law, contact, vibration.sliding_m_per_s);
}

}  // namespace sonoglide::tests
