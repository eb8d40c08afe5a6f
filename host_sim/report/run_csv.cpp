#include "host_sim/report/run_csv.hpp"

#include <cmath>
#include <iterator>
#include <utility>

#include <fmt/compile.h>

#include "firmware/control/interface/names.hpp"
#include "firmware/numeric/float_format.hpp"
#include "host_sim/process/output_folder.hpp"
#include "host_sim/report/words.hpp"
#include "host_sim/scene/names.hpp"

namespace sonoglide::report {
namespace {

void append(fmt::memory_buffer& row, double value) {
  if (std::isnan(value)) {
    row.append(std::string_view("nan"));  // without the sign that a NaN may have
    return;
  }
  fmt::format_to(std::back_inserter(row), FMT_COMPILE("{}"), value);
}

void append_time(fmt::memory_buffer& row, double time_s) {
  fmt::format_to(std::back_inserter(row), FMT_COMPILE("{:.12g}"), time_s);
}

double value_of(const loop::PlantSample& sample, scene::Channel channel) {
  switch (channel) {
    case scene::Channel::displacement:
      return sample.state.displacement_m;
    case scene::Channel::velocity:
      return sample.state.velocity_m_per_s;
    case scene::Channel::friction_force:
      return sample.state.friction_force_N;
    case scene::Channel::drive_force:
      return sample.drive_force_N;
    case scene::Channel::load_displacement:
      return sample.load_displacement_m;
    case scene::Channel::sliding_velocity:
      break;
  }
  return sample.sliding_velocity_m_per_s;
}

}  // namespace

void CsvFile::finish_row() {
  row_.push_back('\n');
  stream_.write(row_.data(), static_cast<std::streamsize>(row_.size()));
  row_.clear();
}

void RepeatingNumber::append_to(fmt::memory_buffer& row, double value) {
  if (text_.size() == 0 || numeric::to_bits(value) != numeric::to_bits(value_)) {
    value_ = value;
    text_.clear();
    append(text_, value);
  }
  row.append(text_.begin(), text_.end());
}

PeriodsCsv::PeriodsCsv(CsvFile file, const AmplitudeUnit& unit, bool of_force, bool biased)
    : file_(std::move(file)), unit_(unit), of_force_(of_force), biased_(biased) {
  fmt::format_to(std::back_inserter(file_.row()),
                 "time_s,friction_ratio,{},drive_amplitude_{},sliding_velocity_m_per_s,limit{}",
                 of_force ? "friction_force_N,target_force_N" : "target", unit.name,
                 biased ? ",bias_N" : "");
  file_.finish_row();
}

void PeriodsCsv::take(const loop::Period& period) {
  fmt::memory_buffer& row = file_.row();
  append_time(row, period.begin_s);
  row.push_back(',');
  append(row, period.friction_ratio);
  row.push_back(',');
  if (of_force_) {
    append(row, period.friction_force_N);
    row.push_back(',');
  }
  target_.append_to(row, period.target);
  row.push_back(',');
  drive_amplitude_.append_to(row, period.drive_amplitude_N * unit_.per_N);
  row.push_back(',');
  sliding_velocity_m_per_s_.append_to(row, period.begin_velocity_m_per_s);
  row.push_back(',');
  row.append(std::string_view(control::name(period.limit)));
  if (biased_) {
    row.push_back(',');
    append(row, period.bias_N);
  }
  file_.finish_row();
}

std::string_view name_of(scene::Channel channel) {
  return scene::name_of(scene::channels, channel);
}

TraceCsv::TraceCsv(CsvFile file, std::vector<scene::Channel> channels)
    : file_(std::move(file)), channels_(std::move(channels)) {
  file_.row().append(std::string_view("time_s"));
  for (const scene::Channel channel : channels_) {
    file_.row().push_back(',');
    file_.row().append(name_of(channel));
  }
  file_.finish_row();
}

void TraceCsv::take(const loop::PlantSample& sample) {
  append_time(file_.row(), sample.time_s);
  for (const scene::Channel channel : channels_) {
    file_.row().push_back(',');
    append(file_.row(), value_of(sample, channel));
  }
  file_.finish_row();
}

std::optional<RecordingSize> recording_size(const scene::Scene& scene) {
  if (scene.run.record.empty()) {
    return std::nullopt;
  }
  constexpr double time_bytes = 12.0;
  constexpr double number_bytes = 22.0;
  constexpr double period_bytes = 75.0;
  const double rows = std::floor(scene.run.duration_s / scene.run.record_interval_s) + 1.0;
  const double periods = scene.drive ? scene.run.duration_s * scene.drive->frequency_Hz : 1000.0;
  const double row_bytes = time_bytes + number_bytes * static_cast<double>(scene.run.record.size());
  return RecordingSize{rows, periods, rows * row_bytes + periods * period_bytes};
}

}  // namespace sonoglide::report
