/// Experiments in print, and what the friction laws say of them.
#pragma once

#include <algorithm>
#include <string>
#include <vector>

#include "host_sim/output/page.hpp"
#include "host_sim/studies/paper/figure_style.hpp"

namespace sonoglide::paper {

struct Interval {
  double least;
  double most;
};

inline Interval joined(const Interval& one, const Interval& other) {
  return {std::min(one.least, other.least), std::max(one.most, other.most)};
}

/// Measured.
inline constexpr double dong_velocities_m_per_s[] = {20.3e-3, 87e-3};
inline constexpr double dong_reductions[] = {0.62, 0.29};

/// From which speed on such a vibration gains nothing, Vc = (mu kz/kx) omega A (see
/// friction::normal_vibration_ratio). Neither amplitude nor contact is published: amplitudes of 0.5
/// to 5 um, coefficients of 0.1 to 0.8, kz/kx of a Hertzian contact of Poisson's number 0.3.
Interval dong_critical_velocities_m_per_s();

inline constexpr const char* dong_range =
    "amplitude up to the indentation; 0.5 to 5 um; coefficient 0.1 to 0.8; Hertzian springs";

/// Reductions at such a speed, over that range.
/// @param velocity_m_per_s  >= 0
Interval dong_normal(double velocity_m_per_s);

/// A contact by what counts for the law.
struct NormalContact {
  double critical_velocity_m_per_s;
  double amplitude_ratio;  ///< beyond 1 the contact opens
};

/// What the contact would have to be for the law to give both measured reductions.
NormalContact dong_contact();

/// Measured reductions: at rest, at 0.1 mm/s, and over all speeds up to the fastest.
inline constexpr double luo_static_reduction = 0.76;
inline constexpr double luo_slow_m_per_s = 1e-4;
inline constexpr double luo_slow_reduction = 0.85;
inline constexpr double luo_fastest_m_per_s = 1e-3;
inline constexpr Interval luo_reductions = {0.76, 0.89};

/// 0.35 um at 26 kHz: 57 mm/s.
double luo_peak_m_per_s();

/// The slider of 1.1 kg at 0.1 mm/s: luo_2024.toml. Spring, coefficient and contact are not
/// published: a spring that hardly matters, and a Dahl contact with Kt X = Fc.
std::string luo_text();

/// Reductions under that vibration. Nothing is fitted: a range goes over what is not published.
/// @param velocity_m_per_s  >= 0; at 0 friction has no mean, and everything is reduced
Interval luo_coulomb(double velocity_m_per_s);
Interval luo_dahl(double velocity_m_per_s);      ///< every contact stiffness
Interval luo_lugre(double velocity_m_per_s);     ///< simulated; see luo_lugre_range
Interval luo_iwan(double velocity_m_per_s);      ///< simulated, but at rest; see luo_iwan_range
Interval luo_stribeck(double velocity_m_per_s);  ///< see luo_stribeck_range

/// Friction at vanishing speed of an elastic stick, a spring Kt that lets go at Fc, under a
/// vibration of amplitude X: carried forward to Fc once in each period, the spring gives way by Kt
/// X in the mean.
/// @param dahl_number  Kt X/Fc
double elastic_stick_reduction(double dahl_number);

inline constexpr const char* luo_dahl_range = "any contact stiffness";
inline constexpr const char* luo_lugre_range =
    "Kt X/Fc 0.1 to 10; static friction Fc to 2 Fc; Stribeck velocity 1 to 100 mm/s";
inline constexpr const char* luo_iwan_range = "one spring; Kt X/Fc 0.1 to 10";
inline constexpr const char* luo_stribeck_range =
    "least friction at 57 to 570 mm/s; up to a half below the static one";

// Published measurements of friction under vibration against every law that the program has.

// The published measurements beside what the laws say, as charts and as columns.

/// What the laws say of Luo's slider, over the sliding velocity.
struct SlowSliding {
  std::vector<double> speeds_mm_per_s;
  std::vector<Interval> coulomb;
  std::vector<Interval> dahl;
  std::vector<Interval> lugre;
  std::vector<Interval> stribeck;
};

/// @throws loop::ComputationError
SlowSliding slow_sliding();

/// The measured points and the least that each law says.
output::Chart slow_sliding_chart(const SlowSliding& slow);

/// Luo's slider at 0.1 mm/s over the contact stiffness, and what an elastic stick would make of it.
output::Chart contact_stiffness_chart();

/// Normal vibration over the sliding velocity, for some critical velocities.
output::Chart normal_vibration_chart();

std::vector<Column> columns(const SlowSliding& slow);

/// Of the vibration: along the sliding, or normal to the surface. No measurement across the sliding
/// is at hand.
enum class Direction { along, normal };

struct PublishedMeasurement {
  std::string source;
  std::string doi;  ///< "-" where only the paper's word is at hand
  Direction direction;
  Interval velocity_m_per_s;  ///< NaN where it is not given
  Interval reduction;         ///< 1 - friction with vibration / without [-]
};

/// A law's word on a measurement. Where something it needs is not published, a range.
struct Prediction {
  std::string law;
  Direction direction;  ///< that the law is for
  std::string over;     ///< what the range goes over; empty where nothing is open
  Interval reduction;

  /// From the measured range: 0 where they meet; positive where the law promises more.
  double difference(const PublishedMeasurement& measurement) const;
};

struct MeasurementComparison {
  PublishedMeasurement measurement;
  std::vector<Prediction> predictions;
};

/// Of every measurement. Vibration in a direction that is not the law's own reduces nothing.
/// @throws loop::ComputationError
std::vector<MeasurementComparison> compare_measurements();

/// One row for each measurement and law for its direction.
output::Table measurement_table(const std::vector<MeasurementComparison>& comparisons);
std::string measurements_csv(const std::vector<MeasurementComparison>& comparisons);

}  // namespace sonoglide::paper
