/// The loop that holds a vibration velocity at resonance, on a resonator solved in closed form:
/// against the time-optimal bound, and against a sensor that lies.

#include "firmware/control/vibration/resonant_vibration.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <complex>
#include <cstdint>
#include <deque>
#include <functional>
#include <random>
#include <vector>

#include "firmware/control/limits/current_limit.hpp"
#include "firmware/control/limits/notch_shaper.hpp"
#include "resonator.hpp"
#include "scalars.hpp"

namespace sonoglide::control::resonant_vibration_test {
namespace {

using Complex = std::complex<double>;

/// What the loop is told, as real numbers; velocities per unit of the steady one at full drive.
struct Nominal {
  double quality = 200.0;
  double carrier_Hz = 60e3;
  double natural = 0.0;  ///< believed deviation of the resonance from the carrier
  double gain = 1.0;     ///< believed over true force of the drive
  double noise = 0.0;
  double step = 0.0;  ///< of the frequency word, relative; 0: none
  int delay = 1;      ///< periods from the end of the sampled one until its command acts
};

template <class S>
numeric::Split<S> split(double value) {
  const numeric::Split<double> parts = numeric::split(value);
  return {scaled<S>(parts.mantissa), parts.exponent};
}

template <class S, class Current, int MaxDelay = 1>
using Vibration = ResonantVibration<S, MaxDelay, Current>;

template <class S, class Current, int MaxDelay = 1>
typename Vibration<S, Current, MaxDelay>::Parameters parameters(const Nominal& nominal) {
  const double rate = tests::pi / nominal.quality * nominal.gain;
  const double step = nominal.step > 0.0 ? nominal.step : 0x1p-28;
  const bool coarse = step * nominal.quality * nominal.quality > 0.25;
  typename Vibration<S, Current, MaxDelay>::Parameters all{};
  all.resonance = {split<S>(rate),
                   scaled<S>(1.0 / nominal.gain / 16.0),
                   scaled<S>(8.0 * nominal.natural),
                   scaled<S>(-0.4),
                   scaled<S>(0.4),
                   scaled<S>(0.99),
                   scaled<S>(0.5 / 8.0),
                   scaled<S>(0.08),
                   scaled<S>(0.05),
                   scaled<S>(std::max(0.25 * rate, 6.0 * nominal.noise)),
                   scaled<S>(std::min(0.999, 0.5 + 4.0 * nominal.noise / rate)),
                   scaled<S>(std::min(0.999, 2.0 * nominal.noise / rate))};
  all.word = {split<S>(1.0 / (8.0 * step)), split<S>(8.0 * step)};
  all.velocity_gain = scaled<S>(0.8);
  all.calm = scaled<S>(1.0 - 0.15 / 0.8);
  all.quiet = scaled<S>(3.0 * nominal.noise);
  all.phase_gain = scaled<S>(coarse ? 0.0 : 8.0 / tests::two_pi / 16.0);
  all.settled = scaled<S>(4.0 * nominal.noise);
  all.missing = scaled<S>(0.25 * rate);
  all.delay = static_cast<std::uint8_t>(nominal.delay);
  return all;
}

/// Loop and resonator.
template <class S, class Current = FullCurrent<S>, int MaxDelay = 1>
class Bench {
  using Loop = Vibration<S, Current, MaxDelay>;

 public:
  Bench(const Nominal& nominal, const Resonator& resonator)
      : Bench(nominal, resonator, parameters<S, Current, MaxDelay>(nominal)) {}
  Bench(const Nominal& nominal, const Resonator& resonator, const typename Loop::Parameters& all)
      : nominal_(nominal),
        step_(nominal.step > 0.0 ? nominal.step : 0x1p-28),
        loop_(all),
        plant_(resonator),
        coming_(static_cast<std::size_t>(nominal.delay)) {}

  /// One carrier period.
  /// @return the amplitude of its vibration
  double advance(double wanted) {
    const Complex z = plant_.advance(frequency_Hz(), acting_.amplitude);
    Complex read = sensor(z);
    if (nominal_.noise > 0.0) {
      // One after the other: arguments of a call have an order of the compiler's own.
      const double quadrature = normal_(random_);
      const double in_phase = normal_(random_);
      read += nominal_.noise * Complex(in_phase, quadrature);
    }
    typename Loop::Measurement measurement{};
    measurement.in_phase = reading(read.real());
    measurement.quadrature = reading(read.imag());
    fault = fault == Fault::none ? loop_.observe(measurement) : fault;
    const auto [amplitude, named] = loop_.drive(scaled<S>(wanted), NoShaping<S>({}), S{});
    limit = named;
    ResonantCommand<S> command{{amplitude, {}, {}, {}, {}, {}}};
    loop_.after(command);
    coming_.push_back({numeric::to_real(amplitude), command.frequency});
    acting_ = coming_.front();
    coming_.pop_front();
    ++periods;
    return std::abs(z);
  }

  double frequency_Hz() const { return nominal_.carrier_Hz * (1.0 + step_ * acting_.steps); }
  double amplitude() const { return acting_.amplitude; }
  std::int32_t steps() const { return acting_.steps; }
  Resonator& plant() { return plant_; }
  bool settled() const { return loop_.settled(); }

  std::function<Complex(Complex)> sensor = [](Complex z) { return z; };
  Fault fault = Fault::none;
  Limit limit = Limit::none;
  int periods = 0;

 private:
  struct Command {
    double amplitude = 0.0;
    std::int32_t steps = 0;
  };

  static S reading(double x) {
    const double code = std::clamp(std::round(x * 2147483648.0), -2147483648.0, 2147483647.0);
    return numeric::from_code<S>(static_cast<std::int32_t>(code));
  }

  Nominal nominal_;
  double step_;
  Loop loop_;
  Resonator plant_;
  Command acting_;
  std::deque<Command> coming_;
  std::mt19937_64 random_{7};
  std::normal_distribution<double> normal_;
};

struct Settled {
  double at_s = 0.0;  ///< the last time outside ±2 %
  double beyond = 0.0;
};

template <class TestBench>
Settled settle(TestBench& bench, double wanted, double duration_s, double from = 0.0) {
  const double begin_s = bench.plant().time_s();
  Settled found;
  while (bench.plant().time_s() < begin_s + duration_s) {
    const double part = bench.advance(wanted) / wanted - 1.0;
    found.beyond = std::max(found.beyond, wanted > from ? part : -part);
    if (std::abs(part) > 0.02) {
      found.at_s = bench.plant().time_s() - begin_s;
    }
  }
  return found;
}

/// Time-optimal, with drive both ways, in steady velocities at full drive.
double bound_s(double quality, double natural_Hz, double from, double to) {
  const double constant_s = quality / (tests::pi * natural_Hz);
  return to > from ? constant_s * std::log((1.0 - from) / (1.0 - to))
                   : constant_s * std::log((1.0 + from) / (1.0 + to));
}

template <class S>
class ResonantVibrationOf : public testing::Test {};
TYPED_TEST_SUITE(ResonantVibrationOf, Scalars);

TYPED_TEST(ResonantVibrationOf, RingsUpWithinFourPeriodsOfTheTimeOptimalBound) {
  for (const double quality : {50.0, 200.0, 1000.0}) {
    for (const double wanted : {1.0 / 1.5, 1.0 / 3.0, 1.0 / 8.0}) {
      Nominal nominal;
      nominal.quality = quality;
      Bench<TypeParam> bench(nominal, {quality, 60e3});
      const double bound = bound_s(quality, 60e3, 0.0, wanted);
      const Settled found = settle(bench, wanted, 4.0 * bound + 2e-3);
      // Two periods pass before the first command acts.
      EXPECT_LE(found.at_s, bound + 6.0 / 60e3) << quality << ' ' << wanted;
      EXPECT_LE(found.beyond, 0.02);
      EXPECT_EQ(bench.fault, Fault::none);
    }
  }
}

// Until the first command acts, and at the target: each period of delay costs one.
TYPED_TEST(ResonantVibrationOf, AnyDelayCostsItsPeriods) {
  for (const int delay : {0, 1, 2, 3}) {
    Nominal nominal;
    nominal.delay = delay;
    Bench<TypeParam, FullCurrent<TypeParam>, 3> bench(nominal, {nominal.quality, 60e3});
    const double bound = bound_s(nominal.quality, 60e3, 0.0, 1.0 / 3.0);
    const Settled found = settle(bench, 1.0 / 3.0, 4.0 * bound + 2e-3);
    EXPECT_LE(found.at_s, bound + (3.0 + delay) / 60e3) << delay;
    EXPECT_LE(found.beyond, 0.02) << delay;
    EXPECT_EQ(bench.fault, Fault::none) << delay;
  }
}

TYPED_TEST(ResonantVibrationOf, ChangesBothWaysWithinFourPeriodsOfTheBound) {
  for (const double quality : {50.0, 200.0, 1000.0}) {
    Nominal nominal;
    nominal.quality = quality;
    Bench<TypeParam> bench(nominal, {quality, 60e3});
    settle(bench, 0.4, 10e-3);
    double from = 0.4;
    for (const double wanted : {0.25, 0.33, 0.1, 0.5}) {
      const double bound = bound_s(quality, 60e3, from, wanted);
      const Settled found = settle(bench, wanted, 6e-3, from);
      EXPECT_LE(found.at_s, bound + 4.0 / 60e3) << quality << ' ' << from << ' ' << wanted;
      EXPECT_LE(found.beyond, 0.02);
      from = wanted;
    }
  }
}

TYPED_TEST(ResonantVibrationOf, FindsAResonanceThreePercentBesideWithoutAScan) {
  for (const double beside : {-0.03, -0.005, 0.005, 0.03}) {
    for (const double quality : {100.0, 1000.0}) {
      for (const double gain : {0.8, 1.2}) {
        const double natural_Hz = 60e3 * (1.0 + beside);
        Nominal nominal;
        nominal.quality = quality;
        nominal.gain = gain;
        Bench<TypeParam> bench(nominal, {quality, natural_Hz});
        const double bound = bound_s(quality, natural_Hz, 0.0, 1.0 / 3.0);
        const Settled found = settle(bench, 1.0 / 3.0, 20e-3);
        EXPECT_LE(found.at_s, bound + 12.0 / 60e3) << beside << ' ' << quality << ' ' << gain;
        EXPECT_NEAR(bench.frequency_Hz() / natural_Hz, 1.0, 1e-5);
      }
    }
  }
}

TYPED_TEST(ResonantVibrationOf, FollowsASpringThatJumps) {
  struct Jump {
    double quality;
    double stiffness;
    double within_s;
  };
  for (const Jump& jump : {Jump{200.0, 0.01, 1e-3}, Jump{200.0, -0.01, 1e-3},
                           Jump{1000.0, 0.005, 4e-3}, Jump{1000.0, -0.005, 4e-3}}) {
    Nominal nominal;
    nominal.quality = jump.quality;
    Bench<TypeParam> bench(nominal, {jump.quality, 60e3});
    settle(bench, 1.0 / 3.0, 10e-3);
    const double natural_Hz = 60e3 * std::sqrt(1.0 + jump.stiffness);
    bench.plant().set_natural_Hz(natural_Hz);
    EXPECT_LE(settle(bench, 1.0 / 3.0, 20e-3).at_s, jump.within_s);
    EXPECT_NEAR(bench.frequency_Hz() / natural_Hz, 1.0, 1e-5);
  }
}

TYPED_TEST(ResonantVibrationOf, HoldsAgainstNoise) {
  Nominal nominal;
  nominal.noise = 5e-4;
  Bench<TypeParam> bench(nominal, {200.0, 60e3 * 1.01});
  settle(bench, 1.0 / 3.0, 5e-3);
  for (int i = 0; i < 20000; ++i) {
    EXPECT_NEAR(bench.advance(1.0 / 3.0), 1.0 / 3.0, 0.01 / 3.0);
    EXPECT_NEAR(bench.frequency_Hz() / bench.plant().natural_Hz(), 1.0, 2e-4);
  }
}

TYPED_TEST(ResonantVibrationOf, PassesLessThanHalfOfTheNoiseOn) {
  for (const double quality : {50.0, 200.0}) {
    constexpr double wanted = 1.0 / 3.0;
    Nominal nominal;
    nominal.quality = quality;
    nominal.noise = 0.003 * wanted;
    Bench<TypeParam> bench(nominal, {quality, 60e3});
    settle(bench, wanted, 100e-3);
    constexpr int periods = 20000;
    double squares = 0.0;
    for (int i = 0; i < periods; ++i) {
      const double error = bench.advance(wanted) - wanted;
      squares += error * error / periods;
    }
    EXPECT_LE(std::sqrt(squares), 0.5 * nominal.noise) << quality;
  }
}

TYPED_TEST(ResonantVibrationOf, ACoarseFrequencyWordHasNoLimitCycle) {
  for (const double step_Hz : {1.0, 10.0, 36.0, 100.0}) {
    for (const double natural_Hz : {20003.0, 20017.9, 19987.0}) {
      Nominal nominal;
      nominal.quality = 1000.0;
      nominal.carrier_Hz = 20e3;
      nominal.step = step_Hz / 20e3;
      Bench<TypeParam> bench(nominal, {1000.0, natural_Hz});
      settle(bench, 0.2, 60e-3);
      const std::int32_t word = bench.steps();
      for (int i = 0; i < 2000; ++i) {
        EXPECT_NEAR(bench.advance(0.2), 0.2, 1e-4);
        ASSERT_EQ(bench.steps(), word) << step_Hz << ' ' << natural_Hz;
      }
      EXPECT_LE(std::abs(bench.frequency_Hz() - natural_Hz), 0.76 * step_Hz);
    }
  }
}

TYPED_TEST(ResonantVibrationOf, QuietsWhatRangBeforeAndAKnock) {
  Nominal nominal;
  Resonator ringing(200.0, 60e3);
  ringing.knock(-0.5);
  Bench<TypeParam> bench(nominal, ringing);
  EXPECT_LE(settle(bench, 1.0 / 3.0, 5e-3).at_s, 0.5e-3);
  bench.plant().knock(0.2);
  EXPECT_LE(settle(bench, 1.0 / 3.0, 5e-3).at_s, 0.5e-3);
}

TYPED_TEST(ResonantVibrationOf, NamesAVelocityThatTheVoltageCannotHold) {
  Bench<TypeParam> bench({}, {200.0, 60e3});
  bench.plant() = Resonator(100.0, 60e3);  // twice the losses: per unit, half the velocity
  double velocity = 0.0;
  bench.sensor = [](Complex z) { return 0.5 * z; };
  for (int i = 0; i < 1000; ++i) {
    velocity = bench.advance(0.7);
  }
  EXPECT_NEAR(velocity, 1.0, 1e-3);
  EXPECT_EQ(bench.limit, Limit::voltage);
  EXPECT_FALSE(bench.settled());
}

TYPED_TEST(ResonantVibrationOf, NamesAResonanceOutOfItsRange) {
  Bench<TypeParam> bench({}, {200.0, 60e3 * 1.053});  // the range ends at 1.05
  for (int i = 0; i < 2000; ++i) {
    bench.advance(1.0 / 3.0);
  }
  EXPECT_EQ(bench.limit, Limit::frequency_range);
}

/// How many samples pass from an event to the fault.
template <class S>
int samples_to_fault(Bench<S>& bench, double wanted) {
  const int before = bench.periods;
  while (bench.fault == Fault::none && bench.periods < before + 500) {
    bench.advance(wanted);
  }
  return bench.periods - before;
}

TYPED_TEST(ResonantVibrationOf, ADeadSensorIsAFaultWithinStatedSamples) {
  using Loop = Vibration<TypeParam, FullCurrent<TypeParam>>;
  for (const bool from_the_start : {true, false}) {
    Bench<TypeParam> bench({}, {200.0, 60e3});
    if (!from_the_start) {
      settle(bench, 1.0 / 3.0, 5e-3);
    }
    bench.sensor = [](Complex) { return Complex(0.0, 0.0); };
    // The command of a sample shows in the second one after it.
    EXPECT_LE(samples_to_fault(bench, 1.0 / 3.0), Loop::missing_samples + 3);
    EXPECT_EQ(bench.fault, Fault::vibration_missing);
  }
}

TYPED_TEST(ResonantVibrationOf, ASensorWiredBackwardsIsAFaultWithinStatedSamples) {
  Bench<TypeParam> bench({}, {200.0, 60e3});
  bench.sensor = [](Complex z) { return -z; };
  EXPECT_LE(samples_to_fault(bench, 1.0 / 3.0), 200);
  EXPECT_NE(bench.fault, Fault::none);
}

TYPED_TEST(ResonantVibrationOf, AnotherVibrationThanTheDrivesIsAFault) {
  using Loop = Vibration<TypeParam, FullCurrent<TypeParam>>;
  Bench<TypeParam> bench({}, {200.0, 60e3});
  settle(bench, 1.0 / 3.0, 5e-3);
  std::mt19937_64 random(3);
  std::uniform_real_distribution<double> any(-0.7, 0.7);
  bench.sensor = [&](Complex) { return Complex(any(random), any(random)); };
  EXPECT_LE(samples_to_fault(bench, 1.0 / 3.0), 2 * Loop::lost_samples);
  EXPECT_EQ(bench.fault, Fault::resonance_lost);
}

TYPED_TEST(ResonantVibrationOf, CurrentStaysBelowItsLimit) {
  using Current = CurrentLimit<TypeParam>;
  for (const double motional : {0.5, 3.0, 6.0}) {
    for (const double capacitive : {1e-6, 0.5, 2.0}) {
      for (const double tangent : {0.0, 0.02, 0.5}) {
        Nominal nominal;
        auto all = parameters<TypeParam, Current>(nominal);
        const double small = 0.25 / std::max({1.0, motional, capacitive});
        all.current = {split<TypeParam>(motional),
                       split<TypeParam>(1.0 / ((1.0 + tangent * tangent) * capacitive)),
                       scaled<TypeParam>(0.5 * tangent),
                       scaled<TypeParam>(small * motional),
                       scaled<TypeParam>(small * capacitive),
                       scaled<TypeParam>(small),
                       scaled<TypeParam>(0.99 * small)};
        Bench<TypeParam, Current> bench(nominal, {200.0, 60e3}, all);
        double largest = 0.0;
        for (int i = 0; i < 600; ++i) {
          const double u = bench.amplitude();
          const double r = bench.advance(1.0 / 3.0);
          largest = std::max(largest,
                             std::hypot(motional * r + tangent * capacitive * u, capacitive * u));
        }
        EXPECT_LE(largest, 1.01) << motional << ' ' << capacitive << ' ' << tangent;
      }
    }
  }
}

TYPED_TEST(ResonantVibrationOf, GivesNoDriveAtRestForNoVibration) {
  Nominal nominal;
  nominal.noise = 1e-4;
  Bench<TypeParam> bench(nominal, Resonator(nominal.quality, nominal.carrier_Hz));
  for (int k = 0; k < 20; ++k) {
    bench.advance(0.0);
    ASSERT_EQ(bench.amplitude(), 0.0) << k;
  }
  EXPECT_EQ(bench.limit, Limit::none);
}

}  // namespace
}  // namespace sonoglide::control::resonant_vibration_test
