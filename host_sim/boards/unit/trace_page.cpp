#include "host_sim/boards/unit/trace_page.hpp"

#include <fmt/format.h>

#include <cctype>
#include <cstdint>
#include <string>
#include <vector>

#include "host_sim/boards/unit/stream_table.hpp"
#include "host_sim/output/number.hpp"

namespace sonoglide::unit {
namespace {

using output::Curve;
using output::Line;

std::string unit_in_brackets(link::ScaleUnit unit) {
  const std::string name = unit_name(unit).behind_number;
  return fmt::format("[{}]", name.empty() ? "-" : name.substr(1));
}

std::string sentence_of(std::string words) {
  words.front() = static_cast<char>(std::toupper(static_cast<unsigned char>(words.front())));
  return words + ".";
}

class Courses {
 public:
  Courses(const RecordedTrace& trace, const UnitScales& scales)
      : trace_(trace), scales_(scales), time_s_(times_of(trace, scales)) {}

  std::vector<output::Chart> charts() const {
    const auto code = [this](link::Quantity quantity, std::int32_t link::TraceRecord::*member) {
      return values_of(trace_, scales_, quantity, member);
    };
    const auto force = code(link::Quantity::friction_force, &link::TraceRecord::friction_force);
    const auto target = targets_of(trace_, scales_);
    std::vector<output::Chart> all;
    const auto add = [&](const char* title, link::Quantity quantity, std::vector<Curve> curves) {
      all.push_back(chart(title, unit_in_brackets(scales_[quantity].unit), std::move(curves)));
    };
    if (scales_.holds_force()) {
      add("Friction force", link::Quantity::friction_force,
          {{"as read", force, Line::stepped}, {"target", target, Line::stepped}});
    } else {
      add("Friction force", link::Quantity::friction_force, {{"as read", force, Line::stepped}});
      add("Target friction ratio", link::Quantity::target, {{"target", target, Line::stepped}});
    }
    add("Drive amplitude", link::Quantity::amplitude,
        {{"answered", code(link::Quantity::amplitude, &link::TraceRecord::amplitude),
          Line::stepped}});
    add("Sliding velocity", link::Quantity::sliding_velocity,
        {{"as read", code(link::Quantity::sliding_velocity, &link::TraceRecord::sliding_velocity),
          Line::stepped}});
    const auto extra = static_cast<link::TraceExtra>(trace_.state.extra);
    if (extra == link::TraceExtra::bias) {
      add("Bias", link::Quantity::bias,
          {{"answered", code(link::Quantity::bias, &link::TraceRecord::other), Line::stepped}});
    } else if (extra == link::TraceExtra::frequency) {
      all.push_back(chart("Steps of the frequency word above the start's", "[-]",
                          {{"answered", frequency_steps(), Line::stepped}}));
    }
    return all;
  }

  output::Table words() const {
    output::Table table{
        "What the controller said", {"From [ms]", "State", "Limit", "Fault", "Settling"}, {}};
    for (std::size_t i = 0; i < trace_.records.size(); ++i) {
      const std::uint32_t codes = trace_.records[i].codes;
      if (i == 0 || codes != trace_.records[i - 1].codes) {
        std::vector<std::string> row{output::formatted(1e3 * time_s_[i], "{:.3f}")};
        for (std::string& name : names_of_codes(codes)) {
          row.push_back(std::move(name));
        }
        table.rows.push_back(std::move(row));
      }
    }
    return table;
  }

 private:
  std::vector<double> frequency_steps() const {
    std::vector<double> steps;
    for (const link::TraceRecord& record : trace_.records) {
      steps.push_back(record.other);
    }
    return steps;
  }

  output::Chart chart(const char* title, const std::string& unit, std::vector<Curve> curves) const {
    return {title,
            "",
            {"Time since the trigger [s]"},
            {fmt::format("{} {}", title, unit)},
            time_s_,
            std::move(curves),
            "course"};
  }

  const RecordedTrace& trace_;
  const UnitScales& scales_;
  std::vector<double> time_s_;
};

}  // namespace

output::Page page_of(const RecordedTrace& trace, const UnitScales& scales,
                     const std::optional<StepResponse>& response, const std::string& caveat) {
  const Courses courses(trace, scales);
  output::Page page;
  page.title = response ? "Step of a unit" : "Trace of a unit";
  page.lead = fmt::format("A {}, one every {}.", text_of(trace.state),
                          output::quantity(scales.step_s(), "s"));
  if (response) {
    page.notes.push_back(sentence_of(text_of(*response)));
  }
  if (!caveat.empty()) {
    page.warnings.push_back(sentence_of(caveat));
  }
  page.sections.push_back({"Course",
                           "One value for each step of the controller.",
                           courses.charts(),
                           {courses.words()}});
  return page;
}

}  // namespace sonoglide::unit
