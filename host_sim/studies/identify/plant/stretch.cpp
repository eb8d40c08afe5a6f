#include "host_sim/studies/identify/plant/stretch.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "firmware/numeric/scalar.hpp"
#include "hal/board.hpp"
#include "host_sim/loop/control/control_port.hpp"
#include "host_sim/loop/run.hpp"

namespace sonoglide::identify::plant {
namespace {

/// At least so many periods of the natural mode, and of the carrier.
constexpr double lead_in_modes = 16.0;
constexpr std::size_t least_lead_in = 128;

std::size_t lead_in(const scene::Scene& plant, const configure::ControlDesign& design) {
  const double mode_Hz = std::max(plant.plant.natural_Hz(), 1e-3 * plant.drive->frequency_Hz);
  const double steps = lead_in_modes / (mode_Hz * design.scales.step_period_s());
  return std::max(least_lead_in, static_cast<std::size_t>(std::ceil(steps)));
}

/// Answers as it was recorded, and keeps what it reads.
class Player final : public loop::ControlPort {
 public:
  Player(const Stretch& stretch, std::size_t lead_in) : stretch_(stretch), lead_in_(lead_in) {}

  using ControlPort::exchange;

  void set_target(double /*target*/) override {}
  std::vector<numeric::SignalRecord> signals() const override { return {}; }

  hal::Drive exchange(const hal::Sample& sample) override { return answer(sample); }
  hal::ResonantDrive exchange(const hal::VibrationSample& sample) override {
    const RecordedStep& step = this->step();
    return {answer(sample), step.other};
  }
  hal::BiasedDrive exchange_biased(const hal::Sample& sample) override { return biased(sample); }
  hal::BiasedDrive exchange_biased(const hal::MotionSample& sample) override {
    return biased(sample);
  }

  const std::vector<double>& readings() const { return readings_; }

 private:
  const RecordedStep& step() const {
    const std::size_t place = exchanges_ < lead_in_ ? 0 : exchanges_ - lead_in_;
    return stretch_.steps[std::min(place, stretch_.steps.size() - 1)];
  }

  /// Of the drive: rises from 0 to 1 with a slope that has no corner.
  double part() const {
    if (exchanges_ >= lead_in_) {
      return 1.0;
    }
    const double turn = static_cast<double>(exchanges_) / static_cast<double>(lead_in_);
    return 0.5 - 0.5 * std::cos(turn * 0.5 * numeric::two_pi);
  }

  hal::Drive answer(const hal::Sample& sample) {
    const auto amplitude =
        static_cast<std::int32_t>(std::lround(part() * static_cast<double>(step().amplitude)));
    if (exchanges_ >= lead_in_ && readings_.size() < stretch_.steps.size()) {
      readings_.push_back(numeric::from_code<double>(sample.friction_force));
    }
    ++exchanges_;
    return {amplitude, 0, static_cast<std::uint8_t>(control::State::running), 0, 0, 0};
  }

  hal::BiasedDrive biased(const hal::Sample& sample) {
    const double bias = part() * static_cast<double>(step().other);
    return {answer(sample), static_cast<std::int32_t>(std::lround(bias))};
  }

  const Stretch& stretch_;
  std::size_t lead_in_;
  std::size_t exchanges_ = 0;
  std::vector<double> readings_;
};

double sliding_velocity_m_per_s(const configure::ControlDesign& design, const Stretch& stretch) {
  double sum = 0.0;
  for (const RecordedStep& step : stretch.steps) {
    sum += numeric::from_code<double>(step.sliding_velocity);
  }
  return design.scales.velocity_m_per_s * sum / static_cast<double>(stretch.steps.size());
}

}  // namespace

Eigen::VectorXd readings(const Stretch& stretch) {
  Eigen::VectorXd all(static_cast<Eigen::Index>(stretch.steps.size()));
  for (std::size_t i = 0; i < stretch.steps.size(); ++i) {
    all(static_cast<Eigen::Index>(i)) = numeric::from_code<double>(stretch.steps[i].friction_force);
  }
  return all;
}

Eigen::VectorXd modelled_readings(const scene::Scene& plant, const configure::ControlDesign& design,
                                  const Stretch& stretch, Eigen::Index steps,
                                  std::complex<double> free_m_per_s) {
  scene::Scene played = plant;
  played.sliding.profile = {{0.0, sliding_velocity_m_per_s(design, stretch)}};
  played.sensor.adc_bits.reset();
  played.sensor.force_noise_N = 0.0;
  played.run.record.clear();
  played.run.record_interval_s = 0.0;
  played.run.window_start_s = 0.0;
  const std::size_t before = lead_in(plant, design);
  const double natural_rad_per_s = plant.plant.natural_rad_per_s();
  const double turned =
      natural_rad_per_s * static_cast<double>(before) * design.scales.step_period_s();
  const std::complex<double> at_start = free_m_per_s * std::polar(1.0, -turned);
  played.plant.initial_velocity_m_per_s = at_start.real();
  played.plant.initial_displacement_m =
      natural_rad_per_s > 0.0 ? at_start.imag() / natural_rad_per_s : 0.0;
  const double all = static_cast<double>(before) + static_cast<double>(steps) + 1.0;
  // The carrier of a resonant loop may be slower than at its start.
  const double longer = plant.resonant() ? 1.2 : 1.0;
  played.run.duration_s = longer * all * design.scales.step_period_s();
  Player player(stretch, before);
  loop::Watch watch;
  watch.energies = false;
  loop::run(played, design, player, watch);
  return Eigen::Map<const Eigen::VectorXd>(player.readings().data(), steps);
}

}  // namespace sonoglide::identify::plant
