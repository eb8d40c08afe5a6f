/// The oscillator without its contact over one step: linear, hence exact.
#pragma once

#include <array>
#include <cstddef>

#include "firmware/numeric/growth_matrix.hpp"
#include "firmware/numeric/scalar.hpp"
#include "firmware/plant/drive.hpp"
#include "firmware/plant/ramped_cosine.hpp"
#include "firmware/plant/state.hpp"

namespace sonoglide::plant {

/// Change of displacement and velocity.
template <class Scalar>
struct Motion {
  Scalar displacement;
  Scalar velocity;
};

/// Drive force at one instant, and its time derivative; the second one is -value.
template <class Scalar>
struct DriveForce {
  Scalar value;
  Scalar slope;

  /// value y + value'' z
  Scalar bent(Scalar y, Scalar z) const { return value * (y - z); }
};

/// The same of a drive with a second derivative of its own.
template <class Scalar>
struct BendingDriveForce {
  Scalar value;
  Scalar slope;
  Scalar bend;

  Scalar bent(Scalar y, Scalar z) const { return value * y + bend * z; }
};

/// y'' + d y' + k y = drive over steps of one length, by the exponential of the linear system, in
/// which a cosine drive is two more states. Nothing is divided by k, by k - 1 or by d: any spring,
/// any damping, and resonance are alike.
template <class Model, class Drive = typename Model::Drive>
class OscillatorFlow;

template <class Model>
class OscillatorFlow<Model, NoDrive> {
 public:
  using Scalar = typename Model::Scalar;

  /// The drive as the steps follow it.
  class Follower {
   public:
    explicit Follower(const IntervalOf<Model>& /*interval*/) {}
    DriveForce<Scalar> force() const { return {Scalar(0), Scalar(0)}; }
  };

  OscillatorFlow() = default;
  OscillatorFlow(const Model& model, Scalar length)
      : length_(length),
        rate_(Scalar(1) / length),
        growth_(numeric::growth_matrix<Scalar, 2>(
            {{{Scalar(0), Scalar(1)}, {-model.stiffness, -model.damping_force(Scalar(1))}}},
            length)) {}

  Scalar length() const { return length_; }
  /// Steps per unit of time.
  Scalar rate() const { return rate_; }

  /// What one step adds to the motion; the drive moves on by that step.
  Motion<Scalar> advance(const State<Scalar>& state, Follower& /*drive*/) const {
    return {growth_[0][0] * state.displacement + growth_[0][1] * state.velocity,
            growth_[1][0] * state.displacement + growth_[1][1] * state.velocity};
  }

 private:
  Scalar length_ = Scalar(0);
  Scalar rate_ = Scalar(0);
  numeric::SquareMatrix<Scalar, 2> growth_{};
};

template <class Model>
class OscillatorFlow<Model, CosineDrive> {
 public:
  using Scalar = typename Model::Scalar;

  /// The drive as the steps follow it: one rotation each, no cosine.
  class Follower {
   public:
    explicit Follower(const IntervalOf<Model>& interval)
        : phasor_(interval.drive_amplitude, interval.phase_begin) {}
    DriveForce<Scalar> force() const { return {phasor_.in_phase, -phasor_.quadrature}; }

   private:
    friend class OscillatorFlow;
    CosineDrive::Phasor<Scalar> phasor_;
  };

  OscillatorFlow() = default;
  /// States: y, v, a cos(tau), a sin(tau).
  OscillatorFlow(const Model& model, Scalar length)
      : length_(length),
        rate_(Scalar(1) / length),
        growth_(numeric::growth_matrix<Scalar, 4>(
            {{{Scalar(0), Scalar(1), Scalar(0), Scalar(0)},
              {-model.stiffness, -model.damping_force(Scalar(1)), Scalar(1), Scalar(0)},
              {Scalar(0), Scalar(0), Scalar(0), Scalar(-1)},
              {Scalar(0), Scalar(0), Scalar(1), Scalar(0)}}},
            length)) {}

  Scalar length() const { return length_; }
  /// Steps per unit of time.
  Scalar rate() const { return rate_; }

  /// What one step adds to the motion; the drive moves on by that step.
  Motion<Scalar> advance(const State<Scalar>& state, Follower& drive) const {
    auto& [in_phase, quadrature] = drive.phasor_;
    const Motion<Scalar> change = {grown(0, state, in_phase, quadrature),
                                   grown(1, state, in_phase, quadrature)};
    const Scalar in_phase_change = growth_[2][2] * in_phase + growth_[2][3] * quadrature;
    quadrature += growth_[3][2] * in_phase + growth_[3][3] * quadrature;
    in_phase += in_phase_change;
    return change;
  }

 private:
  Scalar grown(std::size_t row, const State<Scalar>& state, Scalar in_phase,
               Scalar quadrature) const {
    const auto& g = growth_[row];
    return (g[0] * state.displacement + g[1] * state.velocity) +
           (g[2] * in_phase + g[3] * quadrature);
  }

  Scalar length_ = Scalar(0);
  Scalar rate_ = Scalar(0);
  numeric::SquareMatrix<Scalar, 4> growth_{};
};

/// With a(t) linear, s its slope and b a constant force there are five more states than y and v:
/// a cos(tau), a sin(tau), s cos(tau), s sin(tau) and b.
template <class Model>
class OscillatorFlow<Model, RampedCosineDrive> {
 public:
  using Scalar = typename Model::Scalar;

  /// The drive as the steps follow it.
  class Follower {
   public:
    explicit Follower(const IntervalOf<Model>& interval)
        : Follower(
              RampedCosineDrive::Phasor<Scalar>(interval.drive_amplitude, interval.phase_begin)) {}
    BendingDriveForce<Scalar> force() const {
      const auto& [in_phase, quadrature, in_phase_slope, quadrature_slope, bias] = drive_;
      return {in_phase + bias, in_phase_slope - quadrature,
              -(in_phase + numeric::twice(quadrature_slope))};
    }

   private:
    friend class OscillatorFlow;
    explicit Follower(const RampedCosineDrive::Phasor<Scalar>& drive)
        : drive_{drive.level.in_phase, drive.level.quadrature, drive.slope.in_phase,
                 drive.slope.quadrature, drive.bias} {}

    std::array<Scalar, 5> drive_;
  };

  OscillatorFlow() = default;
  OscillatorFlow(const Model& model, Scalar length)
      : length_(length),
        rate_(Scalar(1) / length),
        growth_(numeric::growth_matrix<Scalar, size>(generator(model), length)) {}

  Scalar length() const { return length_; }
  /// Steps per unit of time.
  Scalar rate() const { return rate_; }

  /// What one step adds to the motion; the drive moves on by that step.
  Motion<Scalar> advance(const State<Scalar>& state, Follower& drive) const {
    std::array<Scalar, size> from{state.displacement, state.velocity};
    for (std::size_t i = 0; i < drive.drive_.size(); ++i) {
      from[2 + i] = drive.drive_[i];
    }
    std::array<Scalar, size> grown{};
    for (std::size_t row = 0; row < size; ++row) {
      for (std::size_t i = 0; i < size; ++i) {
        grown[row] += growth_[row][i] * from[i];
      }
    }
    for (std::size_t i = 0; i < drive.drive_.size(); ++i) {
      drive.drive_[i] += grown[2 + i];
    }
    return {grown[0], grown[1]};
  }

 private:
  static constexpr std::size_t size = 7;

  static numeric::SquareMatrix<Scalar, size> generator(const Model& model) {
    numeric::SquareMatrix<Scalar, size> rate{};
    rate[0][1] = Scalar(1);  // y' = v
    rate[1] = {-model.stiffness, -model.damping_force(Scalar(1)),
               Scalar(1),        Scalar(0),
               Scalar(0),        Scalar(0),
               Scalar(1)};
    rate[2][3] = Scalar(-1);  // (a cos)' = s cos - a sin
    rate[2][4] = Scalar(1);
    rate[3][2] = Scalar(1);  // (a sin)' = s sin + a cos
    rate[3][5] = Scalar(1);
    rate[4][5] = Scalar(-1);  // (s cos)' = -s sin
    rate[5][4] = Scalar(1);   // (s sin)' = s cos
    return rate;
  }

  Scalar length_ = Scalar(0);
  Scalar rate_ = Scalar(0);
  numeric::SquareMatrix<Scalar, size> growth_{};
};

}  // namespace sonoglide::plant
