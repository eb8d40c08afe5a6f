/// The vibration as a demodulator measures it.
#pragma once

#include <cstddef>
#include <type_traits>
#include <utility>

#include "firmware/numeric/float_elementary.hpp"
#include "firmware/numeric/gauss_legendre.hpp"
#include "firmware/numeric/scalar.hpp"

namespace sonoglide::plant {

/// Observes the steps of one interval (see NoObserver) and integrates the velocity against the
/// carrier, by Gauss-Legendre quadrature in each step: v is smooth there. Over a whole carrier
/// period the vibration velocity is Re(z exp(j phase)), z = (in_phase - j quadrature)/pi.
///
/// Error: a few roundings for steps up to 3 rad of a motion whose harmonics above the fourth are
/// small in a step; a solver's own error comes on top. A step that has more in it offers
/// demodulated(phase), the integrals themselves.
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
    const Rule rule = rule_for(step.length());
    for (std::size_t i = 0; i < rule.count; ++i) {
      const Scalar offset = step.length() * static_cast<Scalar>(rule.node[i]);
      const Scalar weighted =
          step.length() * static_cast<Scalar>(rule.weight[i]) * step.at(offset).velocity;
      const auto carrier = numeric::sine_and_cosine(phase_begin_ + step.begin() + offset);
      in_phase_ += weighted * carrier.cosine;
      quadrature_ += weighted * carrier.sine;
    }
  }

  Scalar in_phase() const { return in_phase_; }      ///< integral of v cos(phase) over tau
  Scalar quadrature() const { return quadrature_; }  ///< of v sin(phase)

 private:
  template <class Step, class = void>
  struct HasOwn : std::false_type {};
  template <class Step>
  struct HasOwn<Step, std::void_t<decltype(std::declval<Step>().demodulated(Scalar(0)))>>
      : std::true_type {};

  struct Rule {
    const double* node;
    const double* weight;
    std::size_t count;
  };

  template <int Count>
  static Rule rule_of() {
    static constexpr auto rule = numeric::gauss_legendre<Count>();
    return {rule.node.data(), rule.weight.data(), rule.node.size()};
  }
  static Rule rule_for(Scalar length) {
    if (length <= Scalar(0.125)) {
      return rule_of<4>();
    }
    return length <= Scalar(1) ? rule_of<8>() : rule_of<16>();
  }

  Scalar phase_begin_;
  Scalar in_phase_ = Scalar(0);
  Scalar quadrature_ = Scalar(0);
};

}  // namespace sonoglide::plant
