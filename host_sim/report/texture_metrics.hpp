/// What a texture becomes: the harmonics of the friction over the sliding distance.
#pragma once

#include <complex>
#include <cstdint>
#include <deque>
#include <vector>

#include "host_sim/loop/watch.hpp"
#include "host_sim/report/step_metrics.hpp"
#include "host_sim/scene/scene.hpp"

namespace sonoglide::report {

/// A harmonic of the period, c in Re(c e^(jh 2π x/P)), x the distance; the mean for h = 0. Of a pass
/// backward the rendered one is mirrored about the wanted one: what comes later has the lower phase
/// in either direction.
struct TextureHarmonic {
  int harmonic;
  std::complex<double> wanted;    ///< ratio, or force over the unit's size
  std::complex<double> rendered;  ///< NaN where no whole period passed
  bool is_faint;                  ///< wanted below 1 % of the largest harmonic

  /// Rendered over wanted, and how much later the rendered one comes, in degrees. Of a faint harmonic
  /// both are noise.
  double amplitude_ratio() const;
  double lag_deg() const;
};

/// Projects what a texture holds onto its harmonics. Periods of the path count that are passed from
/// end to end, in either direction, within the second half of the run.
class TextureMeter final : public loop::PeriodSink {
 public:
  /// @param scene  with a texture; outlives this
  explicit TextureMeter(const scene::Scene& scene);

  void take(const loop::Period& period) override;

  /// The mean, and each harmonic of the wanted texture above a thousandth of its largest, at most 16.
  std::vector<TextureHarmonic> harmonics() const;
  /// Periods of the path that count.
  std::uint64_t passes() const { return passes_; }

  /// The last carrier periods, at most four periods of the path.
  struct Place {
    double distance_m;
    double wanted;  ///< ratio or force [N]
    double reached;
  };
  const std::deque<Place>& places() const { return places_; }

 private:
  using Sums = std::vector<std::complex<double>>;

  void remember(const loop::Period& period);
  void add(double begin_m, double end_m, double value);
  void end_pass(double end_m, bool steady);

  const scene::Scene& scene_;
  const scene::Texture& texture_;
  TargetUnit unit_;
  std::deque<Place> places_;
  std::vector<int> numbers_;  ///< of the harmonics
  Sums sums_;                 ///< over the passes that count
  Sums pass_;                 ///< over the one that is under way
  double entered_m_ = 0.0;    ///< where it began, an end of a period
  double travelled_m_ = 0.0;  ///< in it
  bool counts_ = false;       ///< it began late enough, and has all its values
  std::uint64_t passes_ = 0;
};

double angle_deg(const std::complex<double>& value);

/// Of the texture itself, in closed form.
std::complex<double> harmonic_of(const scene::Texture& texture, int harmonic);

}  // namespace sonoglide::report
