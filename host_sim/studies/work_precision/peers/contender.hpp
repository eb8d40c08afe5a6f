/// What is solved, and what a solver offers to take part.
#pragma once

#include <cstdint>
#include <memory>
#include <string>

namespace sonoglide::peers {

/// A Dahl contact on a driven oscillator, at a constant sliding velocity:
///   y'' = a cos tau - d y' - k y - beta phi,   phi' = kappa (V - |V| phi),   V = r + sigma y'.
/// All dimensionless, in the units of plant::Model. The run begins at tau = 0.
struct Problem {
  double stiffness;          ///< k
  double damping;            ///< d, >= 0
  double friction_force;     ///< beta, > 0
  double contact_stiffness;  ///< kappa, > 0
  double vibration_sign;     ///< sigma: +1 dissipative, -1 as the paper prints it
  double drive_amplitude;    ///< a, >= 0
  double sliding_velocity;   ///< r
  double displacement;       ///< y at the beginning
  double velocity;           ///< y' at the beginning
  double friction;           ///< phi at the beginning
  int periods;               ///< length of the run in carrier periods, > 0
};

inline constexpr double carrier_period = 6.28318530717958647693;  ///< 2 pi, in tau

class Contender {
 public:
  Contender() = default;
  virtual ~Contender() = default;
  Contender(const Contender&) = delete;
  Contender& operator=(const Contender&) = delete;

  /// Back to the beginning of the run.
  virtual void restart() = 0;

  /// Goes on to the end of at least so many more carrier periods, never past the end of the run. A
  /// method that chooses its own steps need not end one there: how a run is cut into calls changes
  /// nothing in it.
  /// @return why the run cannot go on; empty if nothing is wrong
  virtual std::string advance(int periods) = 0;

  /// Integral of phi over tau since the beginning.
  virtual double friction_integral() const = 0;
  /// Steps taken since the beginning.
  virtual std::uint64_t steps() const = 0;
};

// The paper's own method: the classical Runge–Kutta method with a fixed step, written out for this
// one equation as a user after speed would.

/// The drive is read from a table of one carrier period.
/// @param steps_per_period  a whole number, > 0
std::unique_ptr<Contender> rk4_table(const Problem& problem, double steps_per_period);

/// The drive is computed by std::cos at each new instant, two for each step.
/// @param steps_per_period  a whole number, > 0
std::unique_ptr<Contender> rk4_naive(const Problem& problem, double steps_per_period);

// Boost.odeint's Dormand–Prince method, used as its manual has it.

/// Adaptive steps over the plain right-hand side, sgn V taken from V; reversals are not looked for.
/// @param tolerance  absolute and relative, of each step
std::unique_ptr<Contender> odeint_dopri5(const Problem& problem, double tolerance);

// SUNDIALS CVODE with root finding at the reversals, as its manual recommends for a right-hand side
// with a kink.

/// Variable-order Adams method; Newton iteration with the exact dense Jacobian. Between two roots
/// of V its sign is frozen, so that the right-hand side is smooth; at a root the method starts
/// afresh.
/// @param tolerance  absolute and relative, of each step
std::unique_ptr<Contender> cvode_adams(const Problem& problem, double tolerance);

/// The same with fixed-point iteration, which needs no Jacobian: for contacts that are not stiff.
/// @param tolerance  absolute and relative, of each step
std::unique_ptr<Contender> cvode_adams_fixed_point(const Problem& problem, double tolerance);

/// Backward differentiation formulas with Newton iteration, for stiff contacts.
/// @param tolerance  absolute and relative, of each step
std::unique_ptr<Contender> cvode_bdf(const Problem& problem, double tolerance);

}  // namespace sonoglide::peers
