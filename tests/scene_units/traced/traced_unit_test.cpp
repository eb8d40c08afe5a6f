/// The trace of a unit, read over its serial line after a run, is the periods.csv of `run`.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <atomic>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <sstream>
#include <string>
#include <type_traits>
#include <vector>

#include "firmware/app/field_parameters.hpp"
#include "firmware/app/link_service.hpp"
#include "firmware/app/timed_loop.hpp"
#include "firmware/app/unit.hpp"
#include "firmware/control/interface/names.hpp"
#include "hal/timed/volatile_pages.hpp"
#include "host_sim/boards/unit/unit_scales.hpp"
#include "host_sim/configure/read/experiment.hpp"
#include "host_sim/loop/run.hpp"
#include "host_sim/report/run_csv.hpp"
#include "host_sim/report/words.hpp"
#include "tests/common/csv/csv.hpp"
#include "tests/firmware/app/unit/simulated_line.hpp"
#include "tests/scene_units/agreement/period_board.hpp"
#include "tests/scene_units/agreement/scene_unit.hpp"

#define configuration target_step_configuration
#include "target_step/controller_configuration.hpp"
#undef configuration
#define configuration force_target_configuration
#include "force_target/controller_configuration.hpp"
#undef configuration
#define configuration slow_mode_configuration
#include "slow_mode/controller_configuration.hpp"
#undef configuration

namespace sonoglide::app::scene_units_test {
namespace {

using link::Trigger;

constexpr std::size_t steps_kept = 512;
constexpr std::uint16_t steps_before = 50;

/// A unit and the line to its host, in a plant that waits while the host waits for the line. Its service comes
/// round once in so many carrier periods.
template <class Parts>
class TracedPort : public PortOfParts<Parts> {
  using Base = PortOfParts<Parts>;
  using Sample = typename Base::Sample;
  using Drive = typename Base::Drive;

 public:
  /// @param full_scale  of a target, see UnitPort
  TracedPort(const FieldDesign<Parts>& design, double full_scale, const Line& line)
      : full_scale_(full_scale),
        line_(line),
        unit_(design, pages_),
        uart_(line.byte_s(), line.queue_bytes) {
    ask<link::Greeted>(link::Hello{4711});
  }

  void arm(std::uint8_t triggers, std::uint16_t before) {
    ask<link::TraceArmed>(link::ArmTrace{triggers, before});
  }
  /// To be triggered by the next target.
  /// @param step  of the run, before which it is armed
  void arm_at(int step) { arms_at_ = step; }
  /// One that is answered only when a carrier period has passed.
  void restart() {
    send(link::frame_of(link::Restart{}, ++sequence_));
    while (unit_.supervisor().order_end() != OrderEnd::pending) {
      pass_service();
    }
    step({});
    read<link::Restarted>();
  }
  /// Carrier periods without a drive.
  void rest(int periods) {
    unit_.stop();
    for (int i = 0; i < periods; ++i) {
      step({});
    }
  }
  unit::UnitScales scales() {
    link::FullScales told{};
    for (std::uint8_t i = 0; i < told.size(); ++i) {
      told.at(i) = link::full_scale_of(ask<link::Scale>(link::ReadScale{i}));
    }
    return unit::UnitScales(told);
  }
  link::TraceState state() { return ask<link::TraceState>(link::ReadTraceState{}); }
  std::vector<link::TraceRecord> trace() {
    std::vector<link::TraceRecord> records;
    for (std::uint16_t i = 0; i < steps_kept; ++i) {
      records.push_back(ask<link::TraceRecord>(link::ReadTraceRecord{i}));
    }
    return records;
  }

  /// The order of a target is pending when the next step begins, as the controller of `run` has it then.
  void set_target(double target) override {
    const auto millionths = static_cast<std::uint32_t>(std::lround(1e6 * target / full_scale_));
    send(link::frame_of(link::SetTarget{millionths}, ++sequence_));
    while (unit_.supervisor().order_end() != OrderEnd::pending) {
      pass_service();
    }
  }

 private:
  using TracedUnit = Unit<Parts, Pages, std::atomic, steps_kept>;
  static constexpr std::size_t most_bytes = 1024;
  using Bytes = hal::BufferedLink<Uart, 2 * most_bytes, 64>;
  using Service = LinkService<TracedUnit, Bytes, most_bytes>;

  Drive answer(const Sample& sample) override {
    if (steps_++ == arms_at_) {
      arm(static_cast<std::uint8_t>(Trigger::target), steps_before);
    }
    return step(sample);
  }

  Drive step(const Sample& sample) {
    board_.post(sample);
    board_.begin_period();
    loop_.control();
    pass_line(carrier_period_s);
    if (++carriers_ % line_.carriers == 0) {
      loop_.service();
    }
    return board_.latest_drive();
  }

  void pass_line(double time_s) {
    const double end = uart_.now + time_s;
    while (uart_.next() <= end) {
      uart_.now = uart_.next();
      uart_.advance();
      bytes_.transfer();
    }
    uart_.now = end;
    bytes_.transfer();
  }
  void pass_service() {
    pass_line(line_.service_s());
    loop_.service();
  }

  void send(const link::Frame& frame) { uart_.put(wire_bytes(frame)); }

  template <class Answer, class Request>
  Answer ask(const Request& request) {
    send(link::frame_of(request, ++sequence_));
    return read<Answer>();
  }
  template <class Answer>
  Answer read() {
    for (int service = 0; service < 100000; ++service) {
      while (taken_ < uart_.from_unit.size()) {
        const bool whole = decoder_.take(uart_.from_unit[taken_++]) == link::Reception::frame;
        if (whole && decoder_.frame().sequence == sequence_) {
          Answer answer{};
          EXPECT_TRUE(link::read(decoder_.frame(), answer));
          return answer;
        }
      }
      pass_service();
    }
    ADD_FAILURE() << "no answer";
    return {};
  }

  double full_scale_;
  Line line_;
  Pages pages_;
  TracedUnit unit_;
  Uart uart_;
  Bytes bytes_{uart_};
  Service service_{unit_, bytes_};
  PeriodBoard<Sample, Drive> board_;
  NeverReset watchdog_;
  TimedLoop<typename TracedUnit::Supervisor, PeriodBoard<Sample, Drive>, NeverReset, Service> loop_{
      unit_.supervisor(), board_, watchdog_, service_};
  link::FrameDecoder decoder_;
  std::size_t taken_ = 0;
  std::uint16_t sequence_ = 0;
  int carriers_ = 0;
  int steps_ = 0;
  int arms_at_ = -1;
};

/// The code that an ideal sensor of 32 bits gives, as it rounds.
std::int32_t code_of(double value, double full_scale) {
  return static_cast<std::int32_t>(std::floor(value / full_scale * 0x1p31 + 0.5));
}

/// What `run` writes.
csv::Table periods_of(const configure::Experiment& experiment) {
  std::ostringstream text;
  report::PeriodsCsv periods(report::CsvFile(text), report::amplitude_unit(experiment.plant),
                             experiment.design->holds_force,
                             experiment.plant.drive->bias_limit_N > 0.0);
  loop::Watch watch;
  watch.periods.push_back(&periods);
  loop::run(experiment, watch);
  return csv::Table(text.str());
}

/// The answer of step i comes into force as the default drive.delay_periods says.
constexpr std::size_t in_force_after = 2;

/// Records as the text of a table that would have a row for each, compared with those of periods.csv.
class Comparison {
 public:
  Comparison(const configure::Experiment& experiment, const unit::UnitScales& told,
             const std::vector<csv::Row>& rows)
      : experiment_(experiment), told_(told), rows_(rows) {}

  /// @param step  of the run, from 0 on: the sample of that carrier period
  void compare(const link::TraceRecord& record, std::size_t step) {
    const scene::Scene& scene = experiment_.plant;
    const configure::ControlScales& scales = experiment_.design->scales;
    if (step + 1 < rows_.size() && !scene.sensor.velocity_bits) {
      ASSERT_EQ(
          record.sliding_velocity,
          code_of(number(rows_[step + 1], Quantity::sliding_velocity), scales.velocity_m_per_s))
          << step;
      ++velocities;
    }
    if (step < rows_.size() && experiment_.design->holds_force) {
      ASSERT_EQ(record.friction_force,
                code_of(number(rows_[step], Quantity::friction_force), scales.force_N))
          << step;
      ++forces;
    }
    if (step + in_force_after < rows_.size()) {
      compare_answer(record, rows_[step + in_force_after]);
      ++answers;
    }
  }

  std::size_t velocities = 0;
  std::size_t forces = 0;
  std::size_t answers = 0;

 private:
  using Quantity = link::Quantity;

  double number(const csv::Row& row, Quantity quantity) const {
    return row.number(told_.column_of(quantity));
  }
  /// As sonoglide connect writes it, and as `run` does.
  void expect_same(Quantity quantity, const std::string& text, const csv::Row& row) const {
    ASSERT_EQ(text, row.text(told_.column_of(quantity))) << row.text("time_s");
  }

  void compare_answer(const link::TraceRecord& record, const csv::Row& row) {
    const auto text = [&](Quantity quantity, std::int32_t code) {
      return told_.text_of(quantity, static_cast<std::uint32_t>(code));
    };
    expect_same(Quantity::amplitude, text(Quantity::amplitude, record.amplitude), row);
    expect_same(Quantity::target, fmt::format("{}", told_.target_of(record.target)), row);
    if (told_.has(Quantity::bias)) {
      expect_same(Quantity::bias, text(Quantity::bias, record.other), row);
    }
    ASSERT_EQ(control::name(static_cast<control::Limit>(record.codes >> 8 & 0xFF)),
              row.text("limit"))
        << row.text("time_s");
  }

  const configure::Experiment& experiment_;
  const unit::UnitScales& told_;
  const std::vector<csv::Row>& rows_;
};

/// @param arms_at  step before which the trace is armed for the next target; -1: it begins with the run
template <class Parts>
void expect_trace_is_periods(const std::string& file, const FieldDesign<Parts>& design,
                             const Line& line, int arms_at) {
  SCOPED_TRACE(testing::Message() << file << ", " << line);
  const configure::Experiment experiment = experiment::read_file(file, {});
  const csv::Table periods = periods_of(experiment);
  ASSERT_EQ(periods.rows().size(), 360U);
  TracedPort<Parts> port(design, experiment.plant.highest_target(), line);
  port.restart();
  if (arms_at < 0) {
    port.arm(static_cast<std::uint8_t>(Trigger::now), 0);
  } else {
    port.arm_at(arms_at);
  }
  loop::run(experiment.plant, *experiment.design, port);
  port.rest(static_cast<int>(steps_kept));
  const link::TraceState state = port.state();
  ASSERT_EQ(static_cast<link::TracePhase>(state.phase), link::TracePhase::whole);
  // The restart had the first period.
  const std::size_t first = state.first_period - 2;
  const std::size_t trigger = first + state.before;
  if (arms_at >= 0) {
    EXPECT_EQ(state.before, steps_before);
    // The row of the first answer to the new target, and the row before it.
    const bool of_force = experiment.design->holds_force;
    const char* const target = of_force ? "target_force_N" : "target";
    EXPECT_NE(periods.rows().at(trigger + in_force_after).text(target),
              periods.rows().at(trigger + in_force_after - 1).text(target));
  } else {
    EXPECT_EQ(trigger, 0U);
  }
  const unit::UnitScales told = port.scales();
  EXPECT_EQ(told.holds_force(), experiment.design->holds_force);
  EXPECT_EQ(told.has(link::Quantity::bias), experiment.plant.drive->bias_limit_N > 0.0);
  const std::vector<link::TraceRecord> records = port.trace();
  Comparison comparison(experiment, told, periods.rows());
  for (std::size_t i = 0; i < records.size(); ++i) {
    comparison.compare(records[i], first + i);
    if (testing::Test::HasFatalFailure()) {
      return;
    }
  }
  EXPECT_EQ(comparison.answers, 360 - in_force_after - first);
  EXPECT_EQ(comparison.velocities, 359 - first);
  EXPECT_EQ(comparison.forces, experiment.design->holds_force ? 360 - first : 0);
}

template <class Parts>
void expect_traces_are_periods(const std::string& file, const FieldDesign<Parts>& design,
                               const std::vector<int>& arms = {-1, 60, 150}) {
  for (const Line& line :
       {Line{9600, 1, 1}, Line{115200, 16, 8}, Line{460800, 6, 2}, Line{3000000, 128, 32}}) {
    for (const int arms_at : arms) {
      expect_trace_is_periods(file, design, line, arms_at);
    }
  }
}

constexpr auto target_step = SONOGLIDE_FIELD_DESIGN(target_step_configuration);
constexpr auto force_target = SONOGLIDE_FIELD_DESIGN(force_target_configuration);
constexpr auto slow_mode = SONOGLIDE_FIELD_DESIGN(slow_mode_configuration);

TEST(TracedUnit, HoldsAFrictionRatioAsInPeriodsCsv) {
  expect_traces_are_periods(SONOGLIDE_TARGET_STEP, target_step);
}

TEST(TracedUnit, HoldsAForceAsInPeriodsCsv) {
  expect_traces_are_periods(SONOGLIDE_FORCE_TARGET, force_target, {-1});
}

TEST(TracedUnit, AnswersWithABiasAsInPeriodsCsv) {
  expect_traces_are_periods(SONOGLIDE_SLOW_MODE, slow_mode);
}

}  // namespace
}  // namespace sonoglide::app::scene_units_test
