#include "host_sim/loop/plant_run.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <numeric>

#include "host_sim/configure/plant_scales.hpp"
#include "host_sim/loop/plant/failure.hpp"
#include "host_sim/loop/plant/plant_port.hpp"

namespace sonoglide::loop {
namespace {

void add_times(const scene::TimedProfile& profile, std::vector<double>& times_s) {
  for (const scene::TimedValue& row : profile) {
    times_s.push_back(row.time_s);
  }
}

/// Where the sliding, the friction or the spring changes its course, or a window begins; rising.
std::vector<double> cuts_of(const scene::Scene& scene, const SlidingProfile& sliding) {
  std::vector<double> cuts_s = sliding.cuts_s();
  cuts_s.push_back(scene.run.window_start_s);
  for (const scene::TimedProfile* profile :
       {&scene.plant.stiffness_profile, &scene.friction.coefficient_profile,
        &scene.friction.normal_force_profile_N}) {
    add_times(*profile, cuts_s);
  }
  if (scene.load) {
    add_times(scene.load->force_profile_N, cuts_s);
  }
  std::sort(cuts_s.begin(), cuts_s.end());
  return cuts_s;
}

/// Tells the progress inside a carrier period too, so that a run can be ended there.
std::function<void()> pulse(const Watch& watch, const CarrierClock& clock, double duration_s) {
  if (!watch.progress) {
    return {};
  }
  return
      [&progress = watch.progress, &clock, duration_s] { progress(clock.begin_s() / duration_s); };
}

}  // namespace

PlantRun::PlantRun(const scene::Scene& scene, const CarrierClock& clock, const Watch& watch,
                   RunResult& result)
    : scene_(scene),
      clock_(clock),
      result_(result),
      meter_(plant::max_steps_per_advance, pulse(watch, clock, scene.run.duration_s)),
      plant_(make_plant_port(scene)),
      sliding_(SlidingProfile::of(scene)),
      undriven_(scene),
      waveform_(scene.drive ? scene.drive->waveform : scene::Waveform::cosine),
      energies_(watch.energies || scene.transducer.has_value()),
      given_velocity_m_per_s_(sliding_.velocity_m_per_s(0.0)),
      drive_(scene, 0.0, 0.0, 0.0),
      force_(scene),
      cuts_s_(cuts_of(scene, sliding_)),
      sampler_(watch.samples, scene.load.has_value()) {
  if (scene.transducer) {
    result.electrical.emplace();
  }
  if (scene.run.start == scene::Start::steady) {
    result.steady_orbit = find_steady_orbit(scene);
    plant_->begin_at(result.steady_orbit->state, result.steady_orbit->memory);
  }
}

EnergyBalance PlantRun::advance(double amplitude_N, double bias_N) {
  const double begin_s = clock_.begin_s();
  const double end_s = clock_.end_s();
  const double duration_s = clock_.duration_s();
  const double last_cut_s = duration_s - clock_.rounding_s(end_s);
  drive_ = PeriodDrive(scene_, drive_.end_N(), amplitude_N, bias_N);
  const bool has_corner =
      waveform_ == scene::Waveform::square || waveform_ == scene::Waveform::triangle;
  const int parts = has_corner ? 2 : drive_.parts();
  const int pieces = std::lcm(parts, force_.intervals());
  EnergyBalance total;
  const double window_resistance_N_s = result_.window.resistance_impulse_N_s;
  const double window_undriven_s = result_.window.undriven_s;
  load_slides_ = true;
  meter_.begin_period();
  force_.begin_period();
  double from_s = 0.0;
  for (int i = 0; i < pieces && from_s < last_cut_s; ++i) {
    const double cut_s = clock_.period_s() * (i + 1) / pieces;
    const bool last = i + 1 == pieces || !(cut_s < last_cut_s);
    const double until_s = last ? duration_s : cut_s;
    piece(begin_s, from_s, until_s, last ? end_s : begin_s + cut_s,
          drive_.part(has_corner ? 0 : i * parts / pieces), total);
    if ((i + 1) % (pieces / force_.intervals()) == 0) {
      force_.take(total, plant_->state().friction_force_N);
    }
    from_s = until_s;
  }
  if (!load_slides_) {
    total.resistance_impulse_N_s = 0.0;
    total.undriven_s = 0.0;
    result_.window.resistance_impulse_N_s = window_resistance_N_s;
    result_.window.undriven_s = window_undriven_s;
  }
  result_.whole.append(total);
  note_peaks(end_s, total);
  return total;
}

double PlantRun::sliding_velocity_m_per_s() const {
  return scene_.load ? plant_->state().load_velocity_m_per_s : given_velocity_m_per_s_;
}

double PlantRun::load_displacement_m() const {
  return scene_.load ? plant_->state().load_extension_m + pulled_m_ : 0.0;
}

Line PlantRun::load_force(double begin_s, double duration_s) const {
  if (!scene_.load) {
    return {};
  }
  Line force_N = line_over(scene_.load->force_profile_N, 0.0, begin_s, duration_s);
  force_N.middle += added_load_force_N_;
  return force_N;
}

bool PlantRun::in_window(double begin_s) const {
  return begin_s >= scene_.run.window_start_s - clock_.rounding_s(begin_s);
}

void PlantRun::note_peaks(double end_s, const EnergyBalance& period) {
  if (!scene_.transducer) {
    return;
  }
  ElectricalBalance peaks;
  peaks.voltage_peak_V =
      scene_.transducer->voltage_V(std::max(std::abs(drive_.begin_N()), std::abs(drive_.end_N())));
  if (clock_.is_whole()) {
    peaks.current_peak_A = std::abs(
        current_A(*scene_.transducer, drive_, clock_.frequency_Hz(), period.vibration_m_per_s()));
    result_.current_peak_A = std::max(result_.current_peak_A, peaks.current_peak_A);
  }
  if (end_s > scene_.run.window_start_s + clock_.rounding_s(end_s)) {
    result_.electrical->append(peaks);
  }
}

/// One piece of the waveform, which ends until_s after its period began, at end_s.
void PlantRun::piece(double begin_s, double from_s, double until_s, double end_s,
                     const DrivePart& drive, EnergyBalance& total) {
  const double rounding_s = clock_.rounding_s(end_s);
  double done_s = from_s;
  for (; next_cut_ < cuts_s_.size() && cuts_s_[next_cut_] < end_s - rounding_s; ++next_cut_) {
    const double cut_s = cuts_s_[next_cut_];
    const double part_s = cut_s - begin_s;
    if (part_s > done_s + rounding_s) {
      total.append(stretch(begin_s + done_s, part_s - done_s,
                           clock_.drive_rate_rad_per_s() * done_s, cut_s, drive));
      done_s = part_s;
    }
  }
  total.append(stretch(begin_s + done_s, until_s - done_s, clock_.drive_rate_rad_per_s() * done_s,
                       end_s, drive));
}

void PlantRun::copy_state(StateCopy& copy) {
  copy(given_velocity_m_per_s_, pulled_m_, drive_, next_cut_);
  force_.copy_state(copy);
  plant_->copy_state(copy);
}

void PlantRun::finish() {
  result_.final_state = plant_->state();
  result_.final_load_displacement_m = load_displacement_m();
  result_.final_time_s = scene_.run.duration_s;
  result_.solver_steps = plant_->cost().steps;
  result_.solver_events = plant_->cost().events;
}

EnergyBalance PlantRun::stretch(double begin_s, double duration_s, double drive_phase_rad,
                                double end_s, const DrivePart& drive) {
  const double first = given_velocity_m_per_s_;
  const double last = sliding_.velocity_m_per_s(end_s);
  const Line load_force_N = load_force(begin_s, duration_s);
  const Stretch stretch{duration_s,
                        drive_phase_rad,
                        clock_.drive_rate_rad_per_s(),
                        drive.amplitude_N,
                        first,
                        (last - first) / duration_s,
                        waveform_,
                        drive.slope_N_per_rad,
                        drive.bias_N,
                        begin_s,
                        scene_.demodulates(),
                        energies_,
                        &meter_,
                        load_force_N.at(-0.5 * duration_s),
                        load_force_N.slope_per_s,
                        undriven_.is_limit() ? nullptr : &undriven_};
  EnergyBalance energy;
  try {
    const plant::Outcome<double> outcome = solve(begin_s, end_s, stretch, energy);
    if (outcome.error != plant::Error::none) {
      fail(outcome.error, begin_s + outcome.offset);
    }
  } catch (const StepsRanOut& out) {
    fail(plant::Error::too_many_steps, out.time_s);
  }
  undriven_.complete(stretch, energy);
  // However many stretches a carrier period is cut into, one in which the load turns has no ratio.
  load_slides_ = load_slides_ && !(scene_.load && scene_.drive && energy.undriven_s == 0.0);
  energy.normal_impulse_N_s =
      energy.load_s *
      configure::contact_at(scene_.friction, begin_s + 0.5 * duration_s).normal_force_N;
  given_velocity_m_per_s_ = last;
  pulled_m_ += 0.5 * (first + last) * duration_s;
  if (in_window(begin_s)) {
    result_.window.append(energy);
    if (scene_.transducer) {
      result_.electrical->append(electrical_balance(*scene_.transducer, stretch, energy));
    }
  }
  return energy;
}

plant::Outcome<double> PlantRun::solve(double begin_s, double end_s, const Stretch& stretch,
                                       EnergyBalance& energy) {
  if (!sampler_.wants_before(end_s)) {
    return plant_->advance(stretch, energy);
  }
  const bool ends_run = end_s >= scene_.run.duration_s - clock_.rounding_s(end_s);
  const std::vector<double>& offsets_s = sampler_.plan(begin_s, end_s, ends_run);
  seen_.clear();
  const plant::Outcome<double> outcome = plant_->advance_sampled(stretch, offsets_s, energy, seen_);
  if (outcome.error == plant::Error::none) {
    sampler_.deliver(begin_s, stretch, seen_, pulled_m_);
  }
  return outcome;
}

void PlantRun::fail(plant::Error error, double time_s) const {
  throw ComputationError(failure_reason(scene_, error, time_s, plant_->state(), plant_->cost()));
}

}  // namespace sonoglide::loop
