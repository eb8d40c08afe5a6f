/// The friction laws of scenes as equations in SI units, in pieces that are smooth: written from
/// the literature, for an integrator of other origin.
#pragma once

#include <array>
#include <cstddef>
#include <memory>
#include <string_view>

namespace sonoglide::equations {

inline constexpr std::size_t most_elements = 8;

/// x, x', the integral of F sgn(Vt), and what the contact remembers.
using State = std::array<double, 3 + most_elements>;
inline constexpr std::size_t impulse = 2;
inline constexpr std::size_t memory = 3;

struct Mass {
  double mass_kg;
  double stiffness_N_per_m;
  double damping_N_s_per_m;
};

/// What a law names of these is its own; see README for the meaning.
struct Contact {
  double coefficient;
  double normal_force_N;
  double contact_stiffness_N_per_m;
  double static_coefficient;
  double stribeck_velocity_m_per_s;
  double bristle_damping_N_s_per_m;
  double viscous_friction_N_s_per_m;
  double fall_s_per_m;
  double rise_s3_per_m3;
  double normal_contact_stiffness_N_per_m;
  std::size_t elements;  ///< of Iwan's springs, at most most_elements

  double limit_N() const { return coefficient * normal_force_N; }
};

/// What acts at one instant.
struct Instant {
  double drive_N;
  double sliding_m_per_s;
  double sliding_m_per_s2;
  double added_stiffness_N_per_m = 0.0;  ///< to that of the spring
  double added_coefficient = 0.0;        ///< to that of the contact
  double added_normal_force_N = 0.0;     ///< likewise
  double coefficient_per_s = 0.0;
  double normal_force_N_per_s = 0.0;
};

/// A contact that is in one piece of its law at a time: sliding one way, holding, lifted off.
class FrictionEquations {
 public:
  FrictionEquations(const Mass& mass, const Contact& contact) : mass_(mass), contact_(contact) {}
  FrictionEquations(const FrictionEquations&) = delete;
  FrictionEquations& operator=(const FrictionEquations&) = delete;
  virtual ~FrictionEquations() = default;

  /// Along the sliding, what the friction ratio is the mean of.
  virtual double friction_N(const State& state, const Instant& now) const = 0;
  /// On the mass, against x.
  virtual double friction_on_mass_N(const State& state, const Instant& now) const {
    return friction_N(state, now);
  }
  virtual void add_memory_rate(const State& /*state*/, const Instant& /*now*/,
                               State& /*rate*/) const {}
  /// Above 0 inside the piece.
  virtual double margin(const State& /*state*/, const Instant& /*now*/) const { return 1.0; }
  /// Into the piece that the contact is in from here on.
  virtual void enter_piece(State& /*state*/, const Instant& /*now*/) {}

  State rate(const State& state, const Instant& now, double sliding_sign) const;

 protected:
  /// Of the drive, the damper and the spring.
  double free_force_N(const State& state, const Instant& now) const;

  double coefficient(const Instant& now) const {
    return contact_.coefficient + now.added_coefficient;
  }
  double load_N(const Instant& now) const {
    return contact_.normal_force_N + now.added_normal_force_N;
  }
  double limit_N(const Instant& now) const { return coefficient(now) * load_N(now); }
  double limit_N_per_s(const Instant& now) const {
    return coefficient(now) * now.normal_force_N_per_s + now.coefficient_per_s * load_N(now);
  }

  Mass mass_;
  Contact contact_;
};

/// Null where nobody has written the law down here.
std::unique_ptr<FrictionEquations> make_equations(std::string_view law, const Mass& mass,
                                                  const Contact& contact);

}  // namespace sonoglide::equations
