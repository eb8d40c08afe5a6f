#include "host_sim/report/run_report.hpp"

#include <cstddef>
#include <iterator>
#include <system_error>

#include <fmt/format.h>

#include "host_sim/report/control_names.hpp"
#include "host_sim/report/output_folder.hpp"
#include "host_sim/report/run_page.hpp"
#include "host_sim/report/summary.hpp"
#include "host_sim/scene/names.hpp"

namespace sonoglide::report {
namespace {

constexpr const char* trace_file = "trace.csv";

/// A scene's file name need not be UTF-8; JSON must be.
std::string text(const nlohmann::ordered_json& json) {
  constexpr int indent = 2;
  return json.dump(indent, ' ', false, nlohmann::ordered_json::error_handler_t::replace) + "\n";
}

double channel_value(const loop::Recording& trace, std::size_t row, scene::Channel channel) {
  switch (channel) {
    case scene::Channel::displacement:
      return trace.state[row].displacement_m;
    case scene::Channel::velocity:
      return trace.state[row].velocity_m_per_s;
    case scene::Channel::friction_force:
      return trace.state[row].friction_force_N;
    case scene::Channel::drive_force:
      return trace.drive_force_N[row];
    case scene::Channel::sliding_velocity:
      break;
  }
  return trace.sliding_velocity_m_per_s[row];
}

void write_trace(std::ostream& file, const std::vector<scene::Channel>& channels,
                 const loop::Recording& trace) {
  file << "time_s";
  for (const scene::Channel channel : channels) {
    file << ',' << scene::name_of(scene::channels, channel);
  }
  file << '\n';
  fmt::memory_buffer line;
  for (std::size_t row = 0; row < trace.time_s.size(); ++row) {
    line.clear();
    fmt::format_to(std::back_inserter(line), "{:.12g}", trace.time_s[row]);
    for (const scene::Channel channel : channels) {
      fmt::format_to(std::back_inserter(line), ",{:.17g}", channel_value(trace, row, channel));
    }
    line.push_back('\n');
    file.write(line.data(), static_cast<std::streamsize>(line.size()));
  }
}

void write_periods(std::ostream& file, const std::vector<loop::Period>& periods) {
  file << "time_s,friction_ratio,target,drive_amplitude_N,sliding_velocity_m_per_s,limit\n";
  fmt::memory_buffer line;
  for (const loop::Period& period : periods) {
    line.clear();
    fmt::format_to(std::back_inserter(line), "{:.12g},{:.17g},{:.17g},{:.17g},{:.17g},{}\n",
                   period.begin_s, period.friction_ratio, period.target, period.drive_amplitude_N,
                   period.begin_velocity_m_per_s, limit_name(period.limit));
    file.write(line.data(), static_cast<std::streamsize>(line.size()));
  }
}

}  // namespace

void write_run(const std::filesystem::path& out, const scene::Scene& scene,
               const loop::RunResult& result) {
  OutputFolder folder(out);
  folder.write("summary.json", text(summary(scene, result)));
  folder.write("report.html", to_html(run_page(scene, result)));
  write_periods(folder.open("periods.csv"), result.periods);
  const bool records = !scene.run.record.empty();
  if (records) {
    write_trace(folder.open(trace_file), scene.run.record, result.trace);
  }
  folder.commit();
  if (!records) {
    // That of an earlier run would pass for this one's.
    std::error_code ignored;
    std::filesystem::remove(folder.target() / trace_file, ignored);
  }
}

}  // namespace sonoglide::report
