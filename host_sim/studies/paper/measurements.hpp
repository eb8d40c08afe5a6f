/// Published measurements of friction under vibration against every law that the program has.
#pragma once

#include <string>
#include <vector>

#include "host_sim/output/page.hpp"
#include "host_sim/studies/paper/chart.hpp"
#include "host_sim/studies/paper/experiments.hpp"

namespace sonoglide::paper {

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
