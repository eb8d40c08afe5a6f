/// A unit on its board's own timer: what is late, lost or dead ends in zero drive.
#include "firmware/app/timed_loop.hpp"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <cmath>
#include <cstdint>
#include <type_traits>
#include <vector>

#include "firmware/app/control_loop.hpp"
#include "firmware/app/host_ramp.hpp"
#include "hal/no_watchdog.hpp"
#include "tests/common/constants/pi.hpp"
#include "tests/firmware/app/unit/simulated_unit.hpp"

namespace sonoglide::app::timed_loop_test {
namespace {

constexpr auto running = static_cast<std::uint8_t>(control::State::running);
constexpr auto faulted = static_cast<std::uint8_t>(control::State::fault);
constexpr auto overrun = static_cast<std::uint8_t>(UnitFault::overrun);

template <class SupervisorT>
std::uint8_t fault_of(const SupervisorT& supervisor) {
  return supervisor.faults().entry(0).fault;
}

/// Work between steps that takes as many carrier periods as it is told.
class SlowService {
 public:
  explicit SlowService(TimedBoard& board) : board_(board) {}
  void serve() {
    ++served;
    board_.pass(takes);
    takes = 0;
  }
  int takes = 0;
  int served = 0;

 private:
  TimedBoard& board_;
};

class TimedLoopTest : public testing::Test {
 protected:
  using TestedSupervisor = Supervisor<FieldDesign<Parts>::Controller>;
  using Loop = TimedLoop<TestedSupervisor, TimedBoard, CountingWatchdog, SlowService>;

  TimedLoopTest() { supervisor.set_target(0.2F); }

  static void serve(Loop& loop, int periods) {
    for (int i = 0; i < periods; ++i) {
      ASSERT_TRUE(loop.serve());
    }
  }
  /// The latest fault.
  FaultEntry fault() const { return supervisor.faults().entry(0); }

  TestedSupervisor supervisor{field_design.controller_parameters(field_design.presets())};
  TimedBoard board;
  CountingWatchdog watchdog;
  SlowService service{board};
};

TEST_F(TimedLoopTest, HoldsItsTargetAndFeedsTheWatchdogEachPeriod) {
  Loop loop(supervisor, board, watchdog, service);
  serve(loop, 200);
  EXPECT_NEAR(board.ratio(), 0.4, 1e-3);
  EXPECT_EQ(board.latest_drive().state, running);
  EXPECT_EQ(watchdog.feeds, 200);
  EXPECT_EQ(service.served, 200);
  EXPECT_EQ(supervisor.faults().count(), 0U);
}

TEST_F(TimedLoopTest, ALateStepIsAnOverrunWhoseCommandNeverActs) {
  Loop loop(supervisor, board, watchdog, service);
  serve(loop, 100);
  board.step_takes = 1;
  serve(loop, 1);
  EXPECT_EQ(board.latest_drive().amplitude, 0);
  EXPECT_EQ(board.latest_drive().state, faulted);
  EXPECT_EQ(board.latest_drive().fault, overrun);
  EXPECT_EQ(watchdog.feeds, 100);
  EXPECT_EQ(fault().fault, overrun);
  EXPECT_EQ(fault().period, 101U);
  serve(loop, 100);
  // 101 was late: the command of period 100 is still in force in 102, and nothing after.
  EXPECT_EQ(board.in_force[101], board.in_force[100]);
  for (std::size_t k = 102; k < board.in_force.size(); ++k) {
    ASSERT_EQ(board.in_force[k], 0) << k;
  }
  EXPECT_EQ(supervisor.faults().count(), 1U);
}

TEST_F(TimedLoopTest, AStepThatTakesManyPeriodsIsOneOverrun) {
  Loop loop(supervisor, board, watchdog, service);
  serve(loop, 100);
  board.step_takes = 7;
  serve(loop, 10);
  EXPECT_EQ(supervisor.faults().count(), 1U);
  EXPECT_EQ(board.latest_drive().fault, overrun);
}

TEST_F(TimedLoopTest, ServiceThatTakesAWholePeriodIsAnOverrun) {
  Loop loop(supervisor, board, watchdog, service);
  serve(loop, 100);
  service.takes = 1;  // the next period has begun, its step can still be done in time
  serve(loop, 2);
  EXPECT_EQ(supervisor.faults().count(), 0U);
  service.takes = 2;
  serve(loop, 2);
  EXPECT_EQ(board.latest_drive().fault, overrun);
  EXPECT_EQ(board.latest_drive().amplitude, 0);
}

TEST_F(TimedLoopTest, LatenessWithoutDriveIsNoFault) {
  Loop loop(supervisor, board, watchdog, service);
  serve(loop, 10);
  supervisor.stop();
  serve(loop, 10);
  EXPECT_EQ(watchdog.feeds, 20);
  board.step_takes = 50;
  serve(loop, 1);
  EXPECT_EQ(watchdog.feeds, 20);
  EXPECT_EQ(supervisor.faults().count(), 0U);
  serve(loop, 1);
  EXPECT_EQ(board.latest_drive().state, static_cast<std::uint8_t>(control::State::off));
  supervisor.restart();
  serve(loop, 200);
  EXPECT_NEAR(board.ratio(), 0.4, 1e-3);
}

TEST_F(TimedLoopTest, AUnitThatIsAlwaysLateStarvesTheWatchdog) {
  Loop loop(supervisor, board, watchdog, service);
  serve(loop, 10);
  for (int i = 0; i < 100; ++i) {
    board.step_takes = 1;
    serve(loop, 1);
  }
  EXPECT_EQ(watchdog.feeds, 10);
}

TEST_F(TimedLoopTest, AfterAResetByTheWatchdogItWaitsForARestart) {
  watchdog.reset = true;
  Loop loop(supervisor, board, watchdog, service);
  serve(loop, 100);
  EXPECT_EQ(board.latest_drive().state, faulted);
  EXPECT_EQ(fault().fault, static_cast<std::uint8_t>(UnitFault::watchdog_reset));
  EXPECT_EQ(watchdog.feeds, 100);
  for (const std::int32_t amplitude : board.in_force) {
    ASSERT_EQ(amplitude, 0);
  }
  supervisor.restart();
  serve(loop, 200);
  EXPECT_NEAR(board.ratio(), 0.4, 1e-3);
}

TEST_F(TimedLoopTest, AFaultIsLoggedOnceAndLeftByARestartAlone) {
  Loop loop(supervisor, board, watchdog, service);
  serve(loop, 100);
  for (std::uint32_t round = 1; round < 40; ++round) {
    board.fresh = false;
    serve(loop, 5);
    board.fresh = true;
    serve(loop, 5);
    ASSERT_EQ(board.latest_drive().amplitude, 0);
    ASSERT_EQ(board.latest_drive().state, faulted);
    ASSERT_EQ(supervisor.faults().count(), round);
    ASSERT_EQ(fault().fault, static_cast<std::uint8_t>(control::Fault::measurement_missing));
    ASSERT_EQ(fault().period, supervisor.periods() - 9);
    supervisor.restart();
    serve(loop, 50);
    ASSERT_EQ(board.latest_drive().state, running);
  }
  EXPECT_EQ(supervisor.faults().kept(), 16U);
  EXPECT_EQ(supervisor.faults().entry(15).period, fault().period - 15 * 60);
  EXPECT_EQ(watchdog.feeds, 100 + 39 * 60);
}

TEST_F(TimedLoopTest, EndsWhenTheBoardShutsDown) {
  Loop loop(supervisor, board, watchdog, service);
  board.last_period = 50;
  int served = 0;
  while (loop.serve()) {
    ++served;
  }
  EXPECT_EQ(served, 49);
}

TEST_F(TimedLoopTest, RunsWithoutWatchdogAndService) {
  hal::NoWatchdog no_watchdog;
  NoService no_service;
  TimedLoop loop(supervisor, board, no_watchdog, no_service);
  for (int i = 0; i < 200; ++i) {
    ASSERT_TRUE(loop.serve());
  }
  EXPECT_NEAR(board.ratio(), 0.4, 1e-3);
  EXPECT_TRUE((std::is_empty_v<hal::NoWatchdog> && std::is_empty_v<NoService>));
}

/// The tested supervisor after so many carrier periods more: 2^32 of them take a day.
class AgedSupervisor : public Supervisor<FieldDesign<Parts>::Controller> {
 public:
  using Supervisor::Supervisor;
  std::uint32_t periods() const { return Supervisor::periods() + age; }

  std::uint32_t age = 0;
};

// One period lost, at each place around the wrap of both counters.
TEST(TimedLoopWrap, HidesNoLostPeriod) {
  constexpr std::uint32_t before = 40;
  for (int lost_after = 1; lost_after < 80; ++lost_after) {
    AgedSupervisor supervisor(field_design.controller_parameters(field_design.presets()));
    supervisor.set_target(0.2F);
    supervisor.age = 0U - before;
    TimedBoard board(0U - before);
    CountingWatchdog watchdog;
    SlowService service(board);
    TimedLoop loop(supervisor, board, watchdog, service);
    for (int i = 0; i < lost_after; ++i) {
      ASSERT_TRUE(loop.serve());
    }
    ASSERT_EQ(supervisor.faults().count(), 0U) << lost_after;
    service.takes = 2;
    ASSERT_TRUE(loop.serve());
    ASSERT_TRUE(loop.serve());
    ASSERT_EQ(board.latest_drive().fault, overrun) << lost_after;
    ASSERT_EQ(board.latest_drive().amplitude, 0) << lost_after;
    ASSERT_EQ(watchdog.feeds, lost_after + 1);
  }
}

TEST(TimedLoopWrap, IsNoFault) {
  AgedSupervisor supervisor(field_design.controller_parameters(field_design.presets()));
  supervisor.set_target(0.2F);
  supervisor.age = 0U - 300;
  TimedBoard board(0U - 400);
  CountingWatchdog watchdog;
  NoService service;
  TimedLoop loop(supervisor, board, watchdog, service);
  for (int i = 0; i < 800; ++i) {
    ASSERT_TRUE(loop.serve());
  }
  EXPECT_EQ(supervisor.faults().count(), 0U);
  EXPECT_EQ(watchdog.feeds, 800);
  EXPECT_NEAR(board.ratio(), 0.4, 1e-3);
}

// Control goes on in its interrupt; nobody would hear a stop.
TEST(HangingService, TakesTheDriveAwayAndStarvesTheWatchdog) {
  SimulatedFlash flash;
  TestedUnit unit(field_design, flash);
  TimedBoard board;
  CountingWatchdog watchdog;
  NoService service;
  TimedLoop loop(unit.supervisor(), board, watchdog, service);
  unit.restart(0);
  for (int i = 0; i < 200; ++i) {
    ASSERT_TRUE(loop.serve());
  }
  constexpr int limit = 3000;  // 50 ms
  for (int i = 0; i < limit; ++i) {
    ASSERT_TRUE(loop.control());
    ASSERT_GT(board.latest_drive().amplitude, 0) << i;
  }
  EXPECT_EQ(watchdog.feeds, 200 + limit);
  for (int i = 0; i < 100; ++i) {
    ASSERT_TRUE(loop.control());
    ASSERT_EQ(board.latest_drive().amplitude, 0) << i;
  }
  EXPECT_EQ(watchdog.feeds, 200 + limit);
  EXPECT_EQ(board.latest_drive().fault, static_cast<std::uint8_t>(UnitFault::service_stalled));
  EXPECT_EQ(unit.supervisor().faults().count(), 1U);
  // A service that comes round again feeds the watchdog, and restarts nothing.
  ASSERT_TRUE(loop.serve());
  ASSERT_TRUE(loop.serve());
  EXPECT_EQ(watchdog.feeds, 200 + limit + 1);
  EXPECT_EQ(board.latest_drive().amplitude, 0);
}

/// A supervisor with a host, and the loop around it.
class HostedLoopTest : public testing::Test {
 protected:
  using Hosted = Supervisor<FieldDesign<Parts>::Controller, HostRamp>;

  HostedLoopTest() { supervisor.set_target(0.2F); }

  void serve(int periods) {
    for (int i = 0; i < periods; ++i) {
      ASSERT_TRUE(loop.serve());
    }
  }
  void settle() {
    supervisor.restart();
    serve(200);
    ASSERT_NEAR(board.ratio(), 0.4, 1e-3);
  }

  Hosted supervisor{field_design.controller_parameters(field_design.presets())};
  TimedBoard board;
  CountingWatchdog watchdog;
  SlowService service{board};
  TimedLoop<Hosted, TimedBoard, CountingWatchdog, SlowService> loop{supervisor, board, watchdog,
                                                                    service};
};

TEST_F(HostedLoopTest, DrivesOnlyWhenTold) {
  serve(100);
  for (const std::int32_t amplitude : board.in_force) {
    ASSERT_EQ(amplitude, 0);
  }
  EXPECT_EQ(board.latest_drive().state, static_cast<std::uint8_t>(control::State::off));
  settle();
}

TEST_F(HostedLoopTest, RampsDownAlongALine) {
  settle();
  const std::int32_t begin = board.latest_drive().amplitude;
  supervisor.ramp_down(UnitFault::host_silent);
  EXPECT_EQ(fault_of(supervisor), static_cast<std::uint8_t>(UnitFault::host_silent));
  for (int k = 1; k <= HostRamp::periods; ++k) {
    ASSERT_TRUE(supervisor.driving()) << k;
    serve(1);
    const double line = begin * (1.0 - static_cast<double>(k) / HostRamp::periods);
    ASSERT_NEAR(board.latest_drive().amplitude, line, HostRamp::periods) << k;
    ASSERT_EQ(board.latest_drive().state, faulted);
  }
  EXPECT_FALSE(supervisor.driving());
  serve(100);
  EXPECT_EQ(board.latest_drive().amplitude, 0);
  EXPECT_EQ(supervisor.faults().count(), 1U);
  settle();
}

// What the board or a person wants at once is not held up by the ramp.
TEST_F(HostedLoopTest, OnTheRampAStopAnOverrunAndARestartActAtOnce) {
  const std::vector<void (*)(Hosted&, TimedBoard&)> ends{
      [](Hosted& ended, TimedBoard&) { ended.stop(); },
      [](Hosted&, TimedBoard& late) { late.step_takes = 1; },
      [](Hosted& ended, TimedBoard&) { ended.restart(); }};
  int restarts = 0;
  for (const auto end : ends) {
    settle();
    supervisor.ramp_down(UnitFault::host_silent);
    serve(10);
    ASSERT_GT(board.latest_drive().amplitude, 0);
    end(supervisor, board);
    if (supervisor.drive().state == static_cast<std::uint8_t>(control::State::calibrating)) {
      serve(200);
      EXPECT_NEAR(board.ratio(), 0.4, 1e-3);
      ++restarts;
    } else {
      serve(1);
      EXPECT_EQ(board.latest_drive().amplitude, 0);
    }
  }
  EXPECT_EQ(restarts, 1);
  EXPECT_EQ(fault_of(supervisor), static_cast<std::uint8_t>(UnitFault::host_silent));
}

TEST_F(HostedLoopTest, OnlyARunningDriveRampsDown) {
  serve(10);
  supervisor.ramp_down(UnitFault::host_silent);
  supervisor.trip(UnitFault::overrun);
  supervisor.ramp_down(UnitFault::host_silent);
  EXPECT_EQ(supervisor.faults().count(), 1U);
  EXPECT_FALSE(supervisor.driving());
}

// A mode of any frequency between a hundredth and half of the carrier, undamped and static gain 1.
TEST(HostRampTest, LeavesTheRingingThatItStates) {
  using tests::pi;
  for (double angle = 2.0 * pi / 100.0; angle < pi; angle *= 1.003) {
    HostRamp ramp;
    ramp.begin(INT32_MAX);
    double cosine = 0.0;  // the ringing that the steps of the amplitude leave, as a phasor
    double sine = 0.0;
    double last = INT32_MAX;
    for (int k = 0; ramp.falling(); ++k) {
      const double next = ramp.next();
      cosine += (last - next) * std::cos(angle * k);
      sine += (last - next) * std::sin(angle * k);
      last = next;
    }
    EXPECT_EQ(last, 0.0);
    // In steps, w T / 2 becomes N sin(w / 2).
    const double bound = 1.0 / (HostRamp::periods * std::sin(angle / 2.0));
    ASSERT_LE(std::hypot(cosine, sine) / INT32_MAX, bound * (1.0 + 1e-6)) << angle;
  }
}

/// Shows any codes, and keeps what it is driven with.
class ShowingBoard {
 public:
  bool sample(hal::Sample& sample) {
    ++period_;
    sample = shown;
    return true;
  }
  void drive(const hal::Drive& drive) { driven = drive; }
  std::uint32_t period() const { return period_; }

  hal::Sample shown{};
  hal::Drive driven{};

 private:
  std::uint32_t period_ = 0;
};

// What a simulation or a lockstep board computes with the designed controller.
RC_GTEST_PROP(TimedLoopCommands, AreThoseOfTheLockstepLoopBitForBit, ()) {
  control::Controller<Parts> controller(designed);
  controller.set_target(0.2F);
  controller.start();
  ShowingBoard lockstep_board;
  ControlLoop lockstep(controller, lockstep_board);

  SimulatedFlash flash;
  TestedUnit unit(field_design, flash);
  ShowingBoard timed_board;
  hal::NoWatchdog watchdog;
  NoService service;
  TimedLoop timed(unit.supervisor(), timed_board, watchdog, service);
  unit.restart(0);
  timed.serve();  // a restart has a period of its own

  const auto code = rc::gen::arbitrary<std::int32_t>();
  const int periods = *rc::gen::inRange(1, 200);
  const int missing = *rc::gen::inRange(0, 400);
  for (int i = 0; i < periods; ++i) {
    const hal::Sample sample{*code / 2, *code / (1 + i % 12), false, i != missing};
    lockstep_board.shown = sample;
    timed_board.shown = sample;
    RC_ASSERT(lockstep.serve() && timed.serve());
    RC_ASSERT(timed_board.driven.amplitude == lockstep_board.driven.amplitude);
    RC_ASSERT(timed_board.driven.state == lockstep_board.driven.state);
    RC_ASSERT(timed_board.driven.limit == lockstep_board.driven.limit);
    RC_ASSERT(timed_board.driven.fault == lockstep_board.driven.fault);
  }
}

/// Its hardware may have switched the drive off.
class TrippingBoard : public TimedBoard {
 public:
  std::uint8_t tripped() const { return cause; }
  std::uint8_t cause = 0;
};
static_assert(hal::reports_trips<TrippingBoard> && !hal::reports_trips<TimedBoard>);

/// See firmware/link/README.md.
constexpr std::uint8_t external_5 = 64 + 5;

TEST(TrippedBoard, EndsTheDriveInItsPeriodUntilARestartThatComesAfter) {
  Supervisor<FieldDesign<Parts>::Controller> supervisor(
      field_design.controller_parameters(field_design.presets()));
  supervisor.set_target(0.2F);
  TrippingBoard board;
  CountingWatchdog watchdog;
  NoService service;
  TimedLoop loop(supervisor, board, watchdog, service);
  const auto serve = [&](int periods) {
    for (int i = 0; i < periods; ++i) {
      ASSERT_TRUE(loop.serve());
    }
  };
  serve(100);
  EXPECT_GT(board.latest_drive().amplitude, 0);
  board.cause = 5;
  serve(1);
  EXPECT_EQ(board.latest_drive().amplitude, 0);
  EXPECT_EQ(board.latest_drive().state, faulted);
  EXPECT_EQ(board.latest_drive().fault, external_5);
  EXPECT_EQ(fault_of(supervisor), external_5);
  EXPECT_EQ(supervisor.faults().entry(0).period, 101U);
  board.cause = 7;  // the first one stays
  serve(10);
  EXPECT_EQ(board.latest_drive().fault, external_5);
  board.cause = 0;
  serve(10);
  EXPECT_EQ(board.latest_drive().fault, external_5);
  EXPECT_EQ(supervisor.faults().count(), 1U);
  EXPECT_EQ(watchdog.feeds, 121);
  supervisor.restart();
  serve(200);
  EXPECT_NEAR(board.ratio(), 0.4, 1e-3);
  EXPECT_EQ(supervisor.faults().count(), 1U);
}

TEST(TrippedBoard, HasItsForceCalibratedAsEver) {
  TestedUnit::Supervisor supervisor(field_design.controller_parameters(field_design.presets()),
                                    field_design.designed(), 0, 10, OrderedTargets(),
                                    ForceCalibration::of(0, 500'000));
  TrippingBoard board;
  CountingWatchdog watchdog;
  NoService service;
  TimedLoop loop(supervisor, board, watchdog, service);
  for (const std::uint8_t cause : {std::uint8_t{0}, std::uint8_t{5}}) {
    board.cause = cause;
    ASSERT_TRUE(loop.serve());
    EXPECT_EQ(supervisor.friction_force(), 1 << 29);  // half of the contact's half
  }
}

TEST(TrippedBoard, RefusesARestartAndKeepsTheFaultOverAStopWhileItLasts) {
  SimulatedFlash flash;
  TestedUnit unit(field_design, flash);
  TrippingBoard board;
  hal::NoWatchdog watchdog;
  NoService service;
  TimedLoop loop(unit.supervisor(), board, watchdog, service);
  board.cause = 40;  // above the last one
  ASSERT_TRUE(loop.serve());
  EXPECT_EQ(board.latest_drive().fault, 64 + 31);
  const std::uint32_t faults = unit.supervisor().faults().count();
  ASSERT_EQ(unit.restart(faults), Answer::taken);
  ASSERT_TRUE(loop.serve());
  EXPECT_EQ(unit.order_end(), OrderEnd::tripped);
  EXPECT_EQ(board.latest_drive().state, faulted);
  unit.stop();
  ASSERT_TRUE(loop.serve());
  EXPECT_EQ(board.latest_drive().state, faulted);
  ASSERT_EQ(unit.set_target(600000, faults), Answer::taken);  // of the next drive
  ASSERT_TRUE(loop.serve());
  EXPECT_EQ(unit.order_end(), OrderEnd::done);
  EXPECT_EQ(unit.supervisor().faults().count(), faults);
  board.cause = 0;
  ASSERT_EQ(unit.restart(faults), Answer::taken);
  for (int i = 0; i < 200; ++i) {
    ASSERT_TRUE(loop.serve());
  }
  EXPECT_EQ(unit.order_end(), OrderEnd::done);
  EXPECT_NEAR(board.ratio(), 0.6, 1e-3);
}

}  // namespace
}  // namespace sonoglide::app::timed_loop_test
