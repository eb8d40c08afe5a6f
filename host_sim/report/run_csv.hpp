/// The tables of a run, written while it goes.
#pragma once

#include <optional>
#include <ostream>
#include <string_view>
#include <vector>

#include <fmt/format.h>

#include "host_sim/loop/watch.hpp"
#include "host_sim/report/words.hpp"
#include "host_sim/scene/scene.hpp"

namespace sonoglide::report {

/// A stream that takes whole rows.
class CsvFile {
 public:
  /// @param stream  outlives this
  explicit CsvFile(std::ostream& stream) : stream_(stream) {}

  /// The row being written; cleared by finish_row().
  fmt::memory_buffer& row() { return row_; }

  /// @throws what the stream throws
  void finish_row();

 private:
  std::ostream& stream_;
  fmt::memory_buffer row_;
};

/// A column whose value often stays as it was: its text is kept.
class RepeatingNumber {
 public:
  void append_to(fmt::memory_buffer& row, double value);

 private:
  double value_ = 0.0;
  fmt::memory_buffer text_;
};

/// periods.csv: one row for each carrier period; numbers as short as they can be read back.
class PeriodsCsv final : public loop::PeriodSink {
 public:
  /// @param of_force  a friction force is the target, and has a column
  /// @param biased    with a column of the bias
  PeriodsCsv(CsvFile file, const AmplitudeUnit& unit, bool of_force, bool biased);
  void take(const loop::Period& period) override;

 private:
  CsvFile file_;
  AmplitudeUnit unit_;
  bool of_force_;
  bool biased_;
  RepeatingNumber target_;
  RepeatingNumber drive_amplitude_;
  RepeatingNumber sliding_velocity_m_per_s_;
};

/// Of its column.
std::string_view name_of(scene::Channel channel);

/// trace.csv: one column for each recorded channel after that of time.
class TraceCsv final : public loop::SampleSink {
 public:
  TraceCsv(CsvFile file, std::vector<scene::Channel> channels);
  void take(const loop::PlantSample& sample) override;

 private:
  CsvFile file_;
  std::vector<scene::Channel> channels_;
};

struct RecordingSize {
  double trace_rows;
  double period_rows;
  double bytes;  ///< of trace.csv and periods.csv together
};

/// How large the tables of a run will be. The rows follow from the scene; their length is that of
/// measured runs, so that the bytes are within a third (tested).
/// @return nothing where the scene records nothing
std::optional<RecordingSize> recording_size(const scene::Scene& scene);

}  // namespace sonoglide::report
