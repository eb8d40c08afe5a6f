/// A board that is the plant itself: no host and no converter.
#pragma once

#include <cstddef>
#include <cstdint>

#include "firmware/image/plant/signal_path.hpp"
#include "firmware/numeric/scalar.hpp"
#include "firmware/numeric/turn.hpp"
#include "firmware/plant/account.hpp"
#include "firmware/plant/outcome.hpp"
#include "firmware/plant/solver.hpp"
#include "firmware/plant/state.hpp"
#include "hal/board.hpp"

namespace sonoglide::image {

/// Each sample takes one carrier period of the plant, from drive phase 0 to 2 pi, under the latest
/// drive amplitude. The sensor is ideal: the code nearest to the mean friction force of the period,
/// ties toward +infinity. A force beyond the range of codes is at the rail.
///
/// @tparam Solver          one of firmware/plant, in float or double
/// @tparam LatencyPeriods  of the drive, see DriveLatency
template <class Solver, std::size_t LatencyPeriods>
class PlantBoard {
 public:
  using Scalar = typename Solver::Scalar;
  using Model = typename Solver::Model;

  struct Parameters {
    Model model;
    Scalar precision;  ///< the tolerance of an adaptive solver, the step of another
    plant::State<Scalar> initial;
    Scalar full_drive;          ///< drive force at amplitude code 2^31, in units of m L omega^2
    Scalar force_per_friction;  ///< Fc / (2 pi force full scale): of an integral of phi over tau
    Scalar sliding_velocity;    ///< constant, in units of L omega
    std::int32_t sliding_code;  ///< the same as a sample has it
  };

  explicit PlantBoard(const Parameters& parameters)
      : full_drive_(parameters.full_drive),
        force_per_friction_(parameters.force_per_friction),
        sliding_velocity_(parameters.sliding_velocity),
        sliding_code_(parameters.sliding_code),
        state_(parameters.initial) {
    solver_.configure(parameters.model, parameters.precision);
  }

  /// False where the solver cannot go on.
  bool sample(hal::Sample& sample) {
    constexpr Scalar two_pi = numeric::from_real<Scalar>(numeric::two_pi);
    plant::MeanFriction<Scalar> account;
    plant::NoObserver nobody;
    const plant::Outcome<Scalar> outcome =
        solver_.advance({Scalar(0), two_pi, amplitude_.in_force(), sliding_velocity_, Scalar(0)},
                        state_, account, nobody);
    const Scalar force = force_per_friction_ * account.friction_integral;
    const bool in_range = force > Scalar(-1) && force < Scalar(1);
    sample = {numeric::to_code(force), sliding_code_, !in_range, true, at_rail(sliding_code_)};
    return outcome.error == plant::Error::none;
  }

  void drive(const hal::Drive& drive) {
    amplitude_.take(full_drive_ * numeric::from_code<Scalar>(drive.amplitude));
  }

 private:
  Scalar full_drive_;
  Scalar force_per_friction_;
  Scalar sliding_velocity_;
  std::int32_t sliding_code_;
  plant::State<Scalar> state_;
  DriveLatency<Scalar, LatencyPeriods> amplitude_;
  Solver solver_;
};

}  // namespace sonoglide::image
