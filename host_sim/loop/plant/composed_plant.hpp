/// A solver of the core behind the plant's port: SI units outside, dimensionless numbers inside.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <type_traits>
#include <utility>
#include <vector>

#include "firmware/friction/vibration.hpp"
#include "firmware/plant/account.hpp"
#include "firmware/plant/outcome.hpp"
#include "firmware/plant/ramped_cosine.hpp"
#include "firmware/plant/solver.hpp"
#include "firmware/plant/state.hpp"
#include "firmware/plant/velocity_quadrature.hpp"
#include "host_sim/configure/plant_scales.hpp"
#include "host_sim/loop/plant/contact_memory.hpp"
#include "host_sim/loop/plant/plant_port.hpp"
#include "host_sim/loop/plant/step_reader.hpp"

namespace sonoglide::loop {

/// The account of a stretch. Energies that nobody asks for cost a quarter of the time of a plant.
template <class Energies>
struct StretchAccount : Energies {
  bool energies = true;

  template <class Step>
  void add(const Step& step) {
    if (energies) {
      Energies::add(step);
    } else {
      this->friction_integral += step.friction_integral();
    }
  }
};

template <class Solver>
class ComposedPlant final : public PlantPort {
  static_assert(plant::check_solver<Solver>());

 public:
  using Model = typename Solver::Model;

  /// @param solver  configured for the model
  ComposedPlant(const scene::PlantScales& scales, const Model& model, const Solver& solver,
                const typename Model::Motion& initial)
      : scales_(scales), model_(model), solver_(solver) {
    static_cast<typename Model::Motion&>(state_) = initial;
    if constexpr (Model::FrictionLaw::remembers) {
      state_.memory = model.law.memory_at(initial.friction);
    }
  }

  plant::Outcome<double> advance(const Stretch& stretch, EnergyBalance& energy) override {
    StepReader reader;
    return advance(stretch, reader, energy);
  }

  plant::Outcome<double> advance_sampled(const Stretch& stretch,
                                         const std::vector<double>& offsets_s,
                                         EnergyBalance& energy,
                                         std::vector<PlantState>& seen) override {
    seen_.clear();
    StepReader reader;
    reader.read_states(offsets_s, scales_.angular_frequency_rad_per_s, seen_);
    const plant::Outcome<double> outcome = advance(stretch, reader, energy);
    // Offsets that rounding has put past the last step.
    seen_.resize(offsets_s.size(), with_load(state_));
    for (const plant::LoadedState<double>& state : seen_) {
      seen.push_back(in_si_units(state));
    }
    return outcome;
  }

  void begin_at(const PlantState& state, const std::vector<double>& memory) override {
    state_.displacement = state.displacement_m / scales_.length_m;
    state_.velocity = state.velocity_m_per_s / scales_.velocity_m_per_s();
    state_.friction = scales_.friction_N > 0.0 ? state.friction_force_N / scales_.friction_N : 0.0;
    if constexpr (moves) {
      state_.sliding_velocity = state.load_velocity_m_per_s / scales_.velocity_m_per_s();
      state_.extension = state.load_extension_m / scales_.length_m;
    }
    remember(model_.law, memory, state_);
  }
  std::vector<double> memory() const override { return remembered(model_.law, state_); }
  std::vector<double> memory_limits_N() const override {
    std::vector<double> limits = memory_limits(model_.law, state_);
    for (double& limit : limits) {
      limit *= scales_.friction_N;
    }
    return limits;
  }

  PlantState state() const override { return in_si_units(with_load(state_)); }
  plant::Cost cost() const override { return solver_.cost(); }

  void copy_state(StateCopy& copy) override { copy(solver_, state_); }

 private:
  static constexpr bool moves = Model::Sliding::moves;
  using Account = StretchAccount<
      std::conditional_t<moves, plant::LoadedEnergyAccount<double>, plant::EnergyAccount<double>>>;

  static constexpr bool is_normal = Model::FrictionLaw::vibration == friction::Vibration::normal;

  static constexpr bool is_ramped = std::is_same_v<typename Model::Drive, plant::RampedCosineDrive>;
  static constexpr bool is_straight = std::is_same_v<typename Model::Drive, plant::StraightDrive>;

  /// In units of force, as the drive of the model takes it.
  typename Model::Drive::template Amplitude<double> amplitude(const DrivePiece& drive,
                                                              double bias_N) const {
    const double at_zero = drive.at_zero_N / scales_.force_N;
    const double slope = drive.slope_N_per_rad / scales_.force_N;
    if constexpr (is_ramped) {
      return {at_zero, slope, bias_N / scales_.force_N};
    } else if constexpr (is_straight) {
      return {at_zero, slope};
    } else {
      return at_zero;
    }
  }

  double normal_stiffness() const {
    if constexpr (is_normal) {
      return model_.law.normal_stiffness;
    } else {
      return 0.0;
    }
  }

  plant::Outcome<double> advance(const Stretch& stretch, StepReader& reader,
                                 EnergyBalance& energy) {
    const double omega = scales_.angular_frequency_rad_per_s;
    const DrivePiece drive = drive_piece(stretch);
    const plant::IntervalOf<Model> interval = interval_of(stretch, drive);
    const typename Model::Motion before = state_;
    Account account;
    account.energies = stretch.energies || moves;
    LoadMotion motion(scales_.velocity_m_per_s(), stretch.undriven);
    if constexpr (moves) {
      reader.follow(motion);
    }
    plant::Demodulator<double> demodulator(stretch.drive_phase_rad);
    if (stretch.demodulated) {
      reader.demodulate(demodulator);
    }
    plant::MomentDemodulator<double> phase_moment(stretch.drive_phase_rad);
    if constexpr (is_ramped) {
      if (stretch.demodulated) {
        reader.demodulate_moment(phase_moment);
      }
    }
    double moment = 0.0;
    if (!moves && stretch.energies && stretch.sliding_acceleration_m_per_s2 != 0.0) {
      reader.take_moment(moment);
    }
    ContactLoad load(normal_stiffness());
    if constexpr (is_normal) {
      reader.weigh(load);
    }
    if (stretch.meter != nullptr) {
      reader.count(stretch.begin_s, omega, *stretch.meter);
    }
    plant::Outcome<double> outcome = solver_.advance(interval, state_, account, reader);
    energy = balance(stretch, account, before);
    if constexpr (moves) {
      add_load(account, motion, before, energy);
    }
    energy.load_s = load.load() / omega;
    energy.open_s = load.open() / omega;
    energy.momentum_integral_J_s +=
        stretch.sliding_acceleration_m_per_s2 * moment * (inertia_kg() * scales_.length_m / omega);
    if (stretch.demodulated) {
      energy.velocity_in_phase_m = demodulator.in_phase() * scales_.length_m;
      energy.velocity_quadrature_m = demodulator.quadrature() * scales_.length_m;
      energy.velocity_in_phase_moment_m = phase_moment.in_phase() * scales_.length_m;
      energy.velocity_quadrature_moment_m = phase_moment.quadrature() * scales_.length_m;
    }
    outcome.offset /= omega;
    return outcome;
  }

  plant::IntervalOf<Model> interval_of(const Stretch& stretch, const DrivePiece& drive) const {
    const double omega = scales_.angular_frequency_rad_per_s;
    plant::IntervalOf<Model> interval{};
    interval.phase_begin = drive.phase_rad;
    interval.duration = stretch.duration_s * omega;
    interval.drive_amplitude = amplitude(drive, stretch.drive_bias_N);
    interval.sliding_velocity = stretch.sliding_velocity_m_per_s / scales_.velocity_m_per_s();
    interval.sliding_acceleration =
        stretch.sliding_acceleration_m_per_s2 / (scales_.velocity_m_per_s() * omega);
    if constexpr (moves) {
      const double unit_N = scales_.force_N / model_.mass_ratio;
      interval.load_force = stretch.load_force_N / unit_N;
      interval.load_force_rate = stretch.load_force_slope_N_per_s / (unit_N * omega);
    }
    return interval;
  }

  static plant::LoadedState<double> with_load(const typename Model::Motion& state) {
    if constexpr (moves) {
      return state;
    } else {
      return {state, 0.0, 0.0};
    }
  }

  PlantState in_si_units(const plant::LoadedState<double>& state) const {
    return {state.displacement * scales_.length_m, state.velocity * scales_.velocity_m_per_s(),
            state.friction * scales_.friction_N,
            state.sliding_velocity * scales_.velocity_m_per_s(),
            state.extension * scales_.length_m};
  }

  /// What an account without a load takes from the sliding velocity that is given. A friction ratio is
  /// not defined in a stretch in which the body turns or stands, or the contact does not slide.
  void add_load(const Account& account, const LoadMotion& motion,
                const typename Model::Motion& before, EnergyBalance& energy) const {
    const double omega = scales_.angular_frequency_rad_per_s;
    const double energy_J = scales_.force_N * scales_.length_m;
    const double load_J = energy_J / model_.mass_ratio;
    const bool slides = motion.direction() != 0.0 && account.friction_work != 0.0;
    energy.sliding_distance_m = motion.distance() * scales_.length_m;
    energy.resistance_impulse_N_s = slides ? motion.direction() * energy.friction_impulse_N_s : 0.0;
    energy.undriven_s = slides ? motion.undriven() / omega : 0.0;
    energy.momentum_integral_J_s = 0.0;
    energy.load.force_work_J = account.load.force_work * load_J;
    energy.load.spring_pull_work_J = account.load.pull_work * load_J;
    energy.load.damping_work_J = model_.load_damping * account.load.velocity_square * load_J;
    energy.load.stored_begin_J = model_.load_energy(before) * energy_J;
    energy.load.stored_end_J = model_.load_energy(state_) * energy_J;
  }

  EnergyBalance balance(const Stretch& stretch, const plant::EnergyAccount<double>& account,
                        const plant::State<double>& before) const {
    const double duration = stretch.duration_s;
    const double first = stretch.sliding_velocity_m_per_s;
    const double last = first + stretch.sliding_acceleration_m_per_s2 * duration;
    const double sign = first + last < 0.0 ? -1.0 : 1.0;
    const double omega = scales_.angular_frequency_rad_per_s;
    const double energy_J = scales_.force_N * scales_.length_m;
    const double friction_J = scales_.friction_N * scales_.length_m;
    const double travel_m = (state_.displacement - before.displacement) * scales_.length_m;
    const double stored_integral =
        0.5 * (account.velocity_square + model_.stiffness * account.displacement_square);

    EnergyBalance energy;
    energy.duration_s = duration;
    energy.sliding_distance_m = 0.5 * std::abs(first + last) * duration;
    energy.friction_impulse_N_s = account.friction_integral * scales_.friction_N / omega;
    energy.resistance_impulse_N_s = sign * energy.friction_impulse_N_s;
    energy.friction_work_J = account.friction_work * friction_J;
    energy.pull_work_J = account.sliding_work * friction_J;
    energy.drive_work_J = account.drive_work * energy_J;
    energy.damping_work_J = account.damping_work * energy_J;
    energy.stored_begin_J = model_.stored_energy(before) * energy_J;
    energy.stored_end_J = model_.stored_energy(state_) * energy_J;
    energy.stored_integral_J_s = stored_integral * energy_J / omega;
    // Of the sliding velocity at the beginning; advance() adds what its change makes of it.
    energy.momentum_integral_J_s = inertia_kg() * first * travel_m;
    const double area_m2 = scales_.length_m * scales_.length_m;
    energy.displacement_square_m2_s = account.displacement_square * area_m2 / omega;
    energy.velocity_square_m2_per_s = account.velocity_square * area_m2 * omega;
    return energy;
  }

  double inertia_kg() const {
    const double omega = scales_.angular_frequency_rad_per_s;
    return scales_.force_N / (scales_.length_m * omega * omega);
  }

  scene::PlantScales scales_;
  Model model_;
  Solver solver_;
  typename Model::PlantState state_;
  std::vector<plant::LoadedState<double>> seen_;
};

}  // namespace sonoglide::loop
