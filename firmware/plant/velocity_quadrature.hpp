/// Integrals of the velocity times a weight over the steps of a solver, and the vibration by them.
#pragma once

#include <cstddef>
#include <type_traits>
#include <utility>

#include "firmware/numeric/float_elementary.hpp"
#include "firmware/numeric/gauss_legendre.hpp"
#include "firmware/numeric/scalar.hpp"

namespace sonoglide::plant {

namespace detail {

struct QuadratureRule {
  const double* node;
  const double* weight;
  std::size_t count;
};

template <int Count>
QuadratureRule quadrature_rule_of() {
  static constexpr auto rule = numeric::gauss_legendre<Count>();
  return {rule.node.data(), rule.weight.data(), rule.node.size()};
}
template <class Scalar>
QuadratureRule quadrature_rule_for(Scalar length) {
  if (length <= Scalar(0.125)) {
    return quadrature_rule_of<4>();
  }
  return length <= Scalar(1) ? quadrature_rule_of<8>() : quadrature_rule_of<16>();
}

template <class Step, class = void>
struct HasVelocityMoment : std::false_type {};
template <class Step>
struct HasVelocityMoment<Step, std::void_t<decltype(std::declval<Step>().velocity_moment())>>
    : std::true_type {};

}  // namespace detail

/// Calls add(t, w v) at each node of a Gauss-Legendre quadrature of the step: t is the time since
/// the step began, w the weight of the node, v the velocity, which is smooth in a step. The sum of
/// w v f(t) is the integral of v f over the step.
///
/// Error: a few roundings for steps up to 3 rad of a motion whose harmonics above the fourth are
/// small in a step; a solver's own error comes on top.
template <class Step, class Add>
void integrate_velocity(const Step& step, const Add& add) {
  const auto length = step.length();
  using Scalar = std::decay_t<decltype(length)>;
  const detail::QuadratureRule rule = detail::quadrature_rule_for(length);
  for (std::size_t i = 0; i < rule.count; ++i) {
    const Scalar offset = length * static_cast<Scalar>(rule.node[i]);
    add(offset, length * static_cast<Scalar>(rule.weight[i]) * step.at(offset).velocity);
  }
}

/// The integral of t v over the step, t since the step began: by integrate_velocity(), or what a step
/// offers that has more in it.
template <class Step>
auto velocity_moment(const Step& step) {
  if constexpr (detail::HasVelocityMoment<Step>::value) {
    return step.velocity_moment();
  } else {
    std::decay_t<decltype(step.length())> moment{};
    integrate_velocity(step,
                       [&moment](auto offset, auto weighted) { moment += offset * weighted; });
    return moment;
  }
}

// The vibration as a demodulator measures it.

/// Observes the steps of one interval (see NoObserver) and integrates the velocity against the
/// carrier, by integrate_velocity() and with its error. Over a whole carrier period the vibration
/// velocity is Re(z exp(j phase)), z = (in_phase - j quadrature)/pi. A step that has more in it
/// offers demodulated(phase), the integrals themselves.
template <class Scalar>
class Demodulator {
 public:
  /// @param phase_begin  of the interval [rad]
  explicit Demodulator(Scalar phase_begin) : phase_begin_(phase_begin) {}

  template <class Step>
  void operator()(const Step& step) {
    if constexpr (HasOwn<Step>::value) {
      const auto own = step.demodulated(phase_begin_ + step.begin());
      in_phase_ += own.in_phase;
      quadrature_ += own.quadrature;
      return;
    }
    integrate_velocity(step, [this, &step](Scalar offset, Scalar weighted) {
      const auto carrier = numeric::sine_and_cosine(phase_begin_ + step.begin() + offset);
      in_phase_ += weighted * carrier.cosine;
      quadrature_ += weighted * carrier.sine;
    });
  }

  Scalar in_phase() const { return in_phase_; }      ///< integral of v cos(phase) over tau
  Scalar quadrature() const { return quadrature_; }  ///< of v sin(phase)

 private:
  template <class Step, class = void>
  struct HasOwn : std::false_type {};
  template <class Step>
  struct HasOwn<Step, std::void_t<decltype(std::declval<Step>().demodulated(Scalar(0)))>>
      : std::true_type {};

  Scalar phase_begin_;
  Scalar in_phase_ = Scalar(0);
  Scalar quadrature_ = Scalar(0);
};

/// The same of the velocity times the phase: what a drive whose amplitude is linear in the phase is
/// integrated against.
template <class Scalar>
class MomentDemodulator {
 public:
  /// @param phase_begin  of the interval [rad]
  explicit MomentDemodulator(Scalar phase_begin) : phase_begin_(phase_begin) {}

  template <class Step>
  void operator()(const Step& step) {
    integrate_velocity(step, [this, &step](Scalar offset, Scalar weighted) {
      const Scalar phase = phase_begin_ + step.begin() + offset;
      const auto carrier = numeric::sine_and_cosine(phase);
      in_phase_ += weighted * phase * carrier.cosine;
      quadrature_ += weighted * phase * carrier.sine;
    });
  }

  Scalar in_phase() const { return in_phase_; }      ///< integral of v phase cos(phase) over tau
  Scalar quadrature() const { return quadrature_; }  ///< of v phase sin(phase)

 private:
  Scalar phase_begin_;
  Scalar in_phase_ = Scalar(0);
  Scalar quadrature_ = Scalar(0);
};

}  // namespace sonoglide::plant
