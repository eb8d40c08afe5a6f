/// The vibration as a demodulator measures it.
#pragma once

#include <type_traits>
#include <utility>

#include "firmware/numeric/float_elementary.hpp"
#include "firmware/numeric/scalar.hpp"
#include "firmware/plant/velocity_quadrature.hpp"

namespace sonoglide::plant {

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

}  // namespace sonoglide::plant
