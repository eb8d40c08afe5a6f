/// A vibration velocity that is held at the resonance of the plant.
#pragma once

#include <cstddef>
#include <cstdint>

#include "firmware/control/interface/drive_command.hpp"
#include "firmware/control/interface/measurement.hpp"
#include "firmware/control/interface/part_name.hpp"
#include "firmware/control/interface/signals.hpp"
#include "firmware/control/vibration/frequency_word.hpp"
#include "firmware/control/vibration/past_drive.hpp"
#include "firmware/control/vibration/resonance_estimate.hpp"
#include "firmware/control/vibration/vibration_part.hpp"
#include "firmware/numeric/floating.hpp"
#include "firmware/numeric/headroom.hpp"
#include "firmware/numeric/scalar.hpp"

namespace sonoglide::control {

/// One step per carrier period: the frequency goes to where the vibration shows the resonance, and
/// the amplitude u to what brings the velocity r to the wanted one, v:
///   u c = h v + γ (v − r)/q,   w = n + β s/2π,
/// r foreseen at the phase 0 where the answer acts, through the commands that are still under way.
/// The steady error vanishes without an integral: in a steady state h is what holds r.
/// u is limited to the largest amplitude, either way, and to what the current allows.
///
/// @tparam MaxDelay  largest delay, see PastDrive
/// @tparam CurrentT  FullCurrent | CurrentLimit
template <class ScalarT, int MaxDelay, class CurrentT>
class ResonantVibration : public VibrationPart<ScalarT> {
 public:
  static constexpr PartName part_name{"vibration/resonant_vibration", "ResonantVibration"};
  using Scalar = ScalarT;
  using Measurement = VibrationMeasurement<Scalar>;
  using Command = ResonantCommand<Scalar>;
  using Resonance = ResonanceEstimate<Scalar>;
  using Requested = signal::RequestedVelocity;
  static constexpr bool observed = true;
  static constexpr Limit at_full_drive = Limit::voltage;
  /// Samples in a row in which a drive of a quarter or more shows no vibration, until
  /// Fault::vibration_missing.
  static constexpr int missing_samples = 16;
  /// Samples in a row that are not as foreseen, until Fault::resonance_lost. Four samples in
  /// between that are as foreseen make up for one.
  static constexpr int lost_samples = 24;

  struct Parameters {
    typename Resonance::Parameters resonance;
    typename FrequencyWord<Scalar>::Parameters word;
    [[no_unique_address]] typename CurrentT::Parameters current;
    Scalar velocity_gain;  ///< γ: part of a velocity error that a period takes away
    Scalar calm;           ///< part of an error within `quiet` that is left to be
    Scalar quiet;          ///< largest error that noise may be
    Scalar phase_gain;     ///< β/2π as a deviation, base 1/8
    Scalar settled;        ///< what noise adds to the error of a settled velocity
    Scalar missing;        ///< velocity that any resonator in the range shows after a hard drive
    std::uint8_t delay;    ///< 0 … MaxDelay

    template <class Self, class Visitor>
    static constexpr void fields(Self& self, Visitor&& visit) {
      visit("resonance", self.resonance);
      visit("word", self.word);
      visit("current", self.current);
      visit("velocity_gain", self.velocity_gain);
      visit("calm", self.calm);
      visit("quiet", self.quiet);
      visit("phase_gain", self.phase_gain);
      visit("settled", self.settled);
      visit("missing", self.missing);
      visit("delay", self.delay);
    }
  };

  explicit ResonantVibration(const Parameters& parameters)
      : parameters_(parameters),
        resonance_(parameters.resonance),
        word_(parameters.word),
        current_(parameters.current),
        past_(parameters.delay) {}

  void restart(bool rested) {
    resonance_.restart();
    missing_ = 0;
    lost_ = 0;
    settled_ = false;
    if (rested) {
      word_.restart();
      past_.clear();
    }
  }

  /// Takes a sample of usable numbers.
  Fault observe(const Measurement& measurement) {
    const bool foreseen = resonance_.observe(measurement.in_phase, measurement.quadrature,
                                             past_.sampled(1), past_.sampled());
    numeric::observe<signal::VibrationVelocity>(resonance_.modulus());
    const bool hard = numeric::from_real<Scalar>(0.25) <= numeric::abs(past_.sampled().amplitude);
    const bool silent = hard && resonance_.modulus() < parameters_.missing;
    missing_ = silent ? missing_ + 1 : 0;
    if (silent && missing_ >= missing_samples) {
      return Fault::vibration_missing;
    }
    if (!foreseen) {
      lost_ += 4;
      return lost_ >= 4 * lost_samples ? Fault::resonance_lost : Fault::none;
    }
    lost_ -= lost_ > 0 ? 1 : 0;
    return Fault::none;
  }

  static constexpr Scalar highest(Scalar /*ceiling*/) { return whole(); }  // of a velocity

  /// The drive that brings the velocity to a wanted one in [0, 1].
  template <class Shaper>
  Request<Scalar> drive(Scalar velocity, const Shaper& /*shaper*/, Scalar /*ceiling*/) {
    const Scalar foreseen = foreseen_velocity();
    const Scalar miss = velocity - foreseen;
    constexpr int band = -5;
    settled_ =
        numeric::abs(miss) <= parameters_.settled + numeric::scale_by_power_of_two(velocity, band);
    if (!resonance_.is_audible(velocity) && !resonance_.is_audible(resonance_.modulus())) {
      return {Scalar{}, Limit::none};  // at rest, as far as the sensor tells
    }
    if constexpr (CurrentT::limits) {
      return drive_below_current(velocity, foreseen);
    } else {
      const Scalar amplitude = towards_vibration(wanted_amplitude(velocity, miss));
      return {amplitude, limit_of(at_full(amplitude), Limit::voltage)};
    }
  }

  /// Gives the answer its frequency, in steps of the word from the start.
  void after(Command& command) {
    const Scalar rotated = resonance_.cosine() < Scalar{} ? -resonance_.sine() : resonance_.sine();
    const Scalar wanted = resonance_.in_range(
        resonance_.natural() + numeric::rough_product(parameters_.phase_gain, rotated));
    const Scalar deviation = word_.approach(wanted);
    past_.append({command.amplitude, deviation, word_.steps()});
    command.frequency = word_.steps();
  }

  /// Frequency of the period whose sample comes next.
  std::int32_t next_frequency() const { return past_.next().steps; }

  /// The velocity is the one that was last asked for. That no more of a drive would help shows in a
  /// velocity that is not settled.
  bool settled() const { return settled_; }

 private:
  static constexpr Scalar whole() { return numeric::from_code<Scalar>(INT32_MAX); }

  /// At the phase 0 at which the answer acts.
  Scalar foreseen_velocity() const {
    Scalar velocity = resonance_.modulus();
    velocity += numeric::half(resonance_.growth(past_.sampled().amplitude, velocity));
    for (std::size_t i = 0; i < past_.delay(); ++i) {
      velocity += resonance_.growth(past_.under_way(i).amplitude, velocity);
    }
    return velocity;
  }

  /// u c; in fixed point a quarter of it.
  Scalar wanted_amplitude(Scalar velocity, Scalar miss) const {
    const Scalar left =
        numeric::rough_product(parameters_.calm, numeric::clamp_magnitude(miss, parameters_.quiet));
    const Scalar gained = numeric::rough_product(parameters_.velocity_gain, miss - left);
    const Scalar holding = resonance_.holding(velocity);
    if constexpr (numeric::is_fixed_point_v<Scalar>) {
      constexpr Scalar most = numeric::from_real<Scalar>(0.7499);
      const Scalar correcting = numeric::multiplied(numeric::scale_by_power_of_two(gained, -2),
                                                    resonance_.inverse_rate());
      return numeric::scale_by_power_of_two(holding, -2) +
             numeric::clamp_magnitude(correcting, most);
    } else {
      return holding + numeric::multiplied(gained, resonance_.inverse_rate());
    }
  }

  /// The velocity is kept to what the current lets be held, and the amplitude to what it lets pass
  /// while the velocity changes.
  Request<Scalar> drive_below_current(Scalar velocity, Scalar foreseen) const {
    Scalar held = velocity;
    bool limited = false;
    const Scalar holding = resonance_.holding(velocity);
    if (!current_.allows_holding(velocity, holding)) {
      held = current_.velocity(velocity, holding);
      limited = held < velocity;
    }
    const Scalar wanted = towards_vibration(wanted_amplitude(held, held - foreseen));
    const Scalar growth = numeric::max(resonance_.growth(wanted, foreseen), Scalar{});
    const Scalar middle = foreseen + numeric::half(growth);
    Scalar amplitude = wanted;
    if (!current_.allows(wanted, middle)) {
      amplitude = numeric::clamp_magnitude(wanted, current_.highest(middle));
      limited = limited || amplitude != wanted;
    }
    return {amplitude,
            limit_of(limited || at_full(wanted), limited ? Limit::current : Limit::voltage)};
  }

  /// u, limited to ±1; where c is small a drive of 8 u c at most. In fixed point without a
  /// division, d = 1 − |c|: 1/|c| = (1 + d)(1 + d²)(1 + d⁴) within d⁸, which no drive within its
  /// limits needs to see.
  /// @param wanted  of wanted_amplitude()
  Scalar towards_vibration(Scalar wanted) const {
    const Scalar cosine = resonance_.cosine();
    if constexpr (numeric::is_fixed_point_v<Scalar>) {
      return quarter_towards(wanted, cosine);
    } else {
      constexpr Scalar least = numeric::from_real<Scalar>(0.125);
      Scalar divisor = cosine;
      if (numeric::abs(cosine) < least) {
        divisor = cosine < Scalar{} ? -least : least;
      }
      return numeric::clamp_magnitude(wanted / divisor, Scalar{1});
    }
  }
  static Scalar quarter_towards(Scalar quarter, Scalar cosine) {
    // One code below 1, so that the sums below stay within 1.
    constexpr Scalar one = numeric::from_code<Scalar>(INT32_MAX - 1);
    const Scalar d = one - numeric::abs(cosine);
    const Scalar d2 = numeric::rough_product(d, d);
    const Scalar d4 = numeric::rough_product(d2, d2);
    const Scalar secant = numeric::rough_product(
        numeric::rough_product(numeric::half_sum(one, d), numeric::half_sum(one, d2)),
        numeric::half_sum(one, d4));                               // base 8
    const Scalar small = numeric::rough_product(quarter, secant);  // base 32
    const Scalar along = numeric::limited_lift(small, 5);
    return cosine < Scalar{} ? -along : along;
  }

  /// At the largest amplitude, but for what base 32 leaves of it.
  static bool at_full(Scalar amplitude) {
    constexpr Scalar nearly = numeric::from_real<Scalar>(1.0 - 1e-6);
    return nearly <= numeric::abs(amplitude);
  }

  Limit limit_of(bool limited, Limit limit) const {
    if (resonance_.at_end()) {
      return Limit::frequency_range;
    }
    return limited ? limit : Limit::none;
  }

  Parameters parameters_;
  Resonance resonance_;
  FrequencyWord<Scalar> word_;
  [[no_unique_address]] CurrentT current_;
  PastDrive<PastCommand<Scalar>, MaxDelay> past_;
  int missing_ = 0;
  int lost_ = 0;
  bool settled_ = false;
};

}  // namespace sonoglide::control
