/// The observer of a mode that a vibration sensor shows: it finds the natural frequency of a mode that is kicked.
/// With a plant: tests/acceptance/closed_loop/damping_test.cpp.

#include "firmware/control/vibration/mode_observer.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <complex>
#include <cstddef>

#include "scalars.hpp"

namespace sonoglide::control::mode_observer_test {
namespace {

using Complex = std::complex<double>;

constexpr double decay = 0.98;
constexpr double middle = 1.36;  ///< angle of a period, of the row in the middle
constexpr double per_frequency_parameter = 0.04;
constexpr double input_gain = 0.25;
constexpr double forced = 0.25;
constexpr double output = 0.5;

Complex rotation(double frequency_parameter) {
  return std::polar(decay, middle + per_frequency_parameter * frequency_parameter);
}

/// The mode is seen as it is, and corrected by the frequency alone.
/// @param audible  least slope of a forecast over the frequency that a sample shows
template <class S>
typename ModeObserver<S>::Parameters parameters(double audible) {
  typename ModeObserver<S>::Parameters all{};
  for (std::size_t i = 0; i < mode::rows; ++i) {
    const Complex turn = rotation(2.0 * static_cast<double>(i) / (mode::rows - 1) - 1.0);
    ModeRow<S>& row = all.table[i];
    row[mode::rotation] = scaled<S>(turn.real());
    row[mode::rotation + 1] = scaled<S>(turn.imag());
    row[mode::input_gain + 1] = scaled<S>(input_gain);
    row[mode::forced] = scaled<S>(forced);
    row[mode::output] = scaled<S>(output);
    row[mode::output + 3] = scaled<S>(output);
  }
  all.audible = scaled<S>(audible);
  return all;
}

/// Largest error of the mode from the 300th to the 400th period, over the mode's largest modulus there.
template <class S>
double late_error(double frequency_parameter, double audible) {
  const auto nominal = parameters<S>(audible);
  ModeObserver<S> observer(nominal);
  Complex mode;
  double before = 0.0;
  double error = 0.0;
  double modulus = 0.0;
  for (int k = 0; k < 400; ++k) {
    const double now = k / 20 % 2 == 0 ? 0.3 : 0.7;
    mode = mode * rotation(frequency_parameter) + Complex(0.0, input_gain * (now - before));
    const Complex z = forced * now + output * mode;
    observer.observe({scaled<S>(z.real()), scaled<S>(z.imag())}, scaled<S>(before), scaled<S>(now));
    before = now;
    if (k >= 300) {
      const Complex found(numeric::to_real(observer.mode().first),
                          numeric::to_real(observer.mode().second));
      error = std::max(error, std::abs(found - mode));
      modulus = std::max(modulus, std::abs(mode));
    }
  }
  return error / modulus;
}

template <class S>
class ModeObserverOf : public testing::Test {};
TYPED_TEST_SUITE(ModeObserverOf, Scalars);

TYPED_TEST(ModeObserverOf, FindsTheNaturalFrequencyOfAModeThatIsKicked) {
  for (const double frequency_parameter : {-0.9, -0.4, 0.0, 0.3, 0.8}) {
    EXPECT_LT(late_error<TypeParam>(frequency_parameter, 0.001), 5e-4) << frequency_parameter;
  }
}

// It then keeps its nominal frequency, and forecasts a mode that it does not correct wrong.
TYPED_TEST(ModeObserverOf, LeavesTheFrequencyOfAModeThatIsHardlyHeard) {
  for (const double frequency_parameter : {-0.9, -0.4, 0.3, 0.8}) {
    EXPECT_GT(late_error<TypeParam>(frequency_parameter, 0.9), 0.5 * std::abs(frequency_parameter));
  }
  EXPECT_LT(late_error<TypeParam>(0.0, 0.9), 1e-6);
}

}  // namespace
}  // namespace sonoglide::control::mode_observer_test
