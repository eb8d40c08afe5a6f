/// The exponential of a complex number, of the core's own functions: the same bits on every machine.
#pragma once

#include <complex>

#include "firmware/numeric/float_elementary.hpp"

namespace sonoglide::configure {

inline std::complex<double> exponential(std::complex<double> exponent) {
  return numeric::exp(exponent.real()) *
         std::complex<double>{numeric::cos(exponent.imag()), numeric::sin(exponent.imag())};
}

}  // namespace sonoglide::configure
