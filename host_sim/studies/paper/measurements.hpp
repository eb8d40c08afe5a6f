/// Published measurements of friction under vibration against every law that the program has.
#pragma once

#include <string>
#include <vector>

#include "host_sim/output/page.hpp"
#include "host_sim/studies/paper/experiments.hpp"

namespace sonoglide::paper {

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
