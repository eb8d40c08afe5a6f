/// A supervised controller whose orders come from a service that it may interrupt.
#pragma once

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <type_traits>

#include "firmware/app/force_calibration.hpp"
#include "firmware/app/host_ramp.hpp"
#include "firmware/app/order_slot.hpp"
#include "firmware/app/signs_of_life.hpp"
#include "firmware/app/snapshot.hpp"
#include "firmware/app/supervisor.hpp"
#include "firmware/app/target_schedule.hpp"
#include "firmware/app/trace.hpp"
#include "hal/board.hpp"

namespace sonoglide::app {

/// The control side is called once in each carrier period, from the carrier's interrupt or from a loop:
/// step(), trip(), serviced() and publish(). The service side is called from anywhere that the control
/// side may interrupt. No side waits for the other.
///
/// In each carrier period the control side does one of these: a stop, an order to restart or to take
/// other parameters, or a step of the controller, with a new target if one is ordered. So its longest
/// period is hardly longer than a step. In the period of a restart the drive is at zero. An order is a sign
/// of life, so nobody else is watched in its period.
///
/// If the host is silent for longer than the timeout while the unit drives, the fault is host_silent, and
/// the drive ramps down. If the service does not come round for its time while the unit drives, the
/// fault is service_stalled: nobody could stop the drive any more.
///
/// @tparam Designed      see Controller::settle_at
/// @tparam Atomic        std::atomic, or what a test puts in its place
/// @tparam TraceRecords  of its trace; 0: it has none
/// @tparam Course        of the target: OrderedTargets or TextureCourse
template <class ControllerT, class Designed, template <class> class Atomic = std::atomic,
          std::size_t TraceRecords = 0, class Course = OrderedTargets>
class CommandedSupervisor : private SignsOfLife<Atomic>,
                            private CalibrationOf<ControllerT>,
                            private ShownPeriod<Atomic>,
                            public Supervisor<ControllerT, HostRamp> {
  // What each carrier period reads and writes is in the bases, near the beginning, as in Supervisor.
  using Signs = SignsOfLife<Atomic>;
  using Base = Supervisor<ControllerT, HostRamp>;

 public:
  using Scalar = typename Base::Scalar;
  using Sample = typename Base::Sample;
  using Drive = typename Base::Drive;
  using Parameters = typename ControllerT::Parameters;
  using Calibration = CalibrationOf<ControllerT>;
  using Recorder = std::conditional_t < TraceRecords == 0, NoTrace,
        Trace<TraceRecords<2 ? 2 : TraceRecords, Drive, Atomic>>;

  enum class Kind : std::uint8_t { restart, target, parameters };

  /// What is ordered; a later fault than those it knows of overtakes a restart and a target.
  struct Order {
    explicit Order(const Parameters& parameters) : controller(parameters) {}

    Kind kind = Kind::restart;
    std::uint32_t faults = 0;
    Scalar target{};
    std::uint32_t timeout_periods = 0;
    [[no_unique_address]] Calibration calibration{};
    ControllerT controller;  ///< of other parameters; made by the service, which has the time
  };

  using Work = typename OrderSlot<Order, Atomic>::Work;

  /// @param parameters       of the controller
  /// @param designed         where it finds its tables; outlives this
  /// @param timeout_periods  for which the host may be silent; 0: for ever
  /// @param service_periods  in which the service comes round
  /// @param course           of the target, see course_of()
  /// @param calibration      of the force sensor
  CommandedSupervisor(const Parameters& parameters, const Designed& designed,
                      std::uint32_t timeout_periods, std::uint32_t service_periods,
                      const Course& course = Course(),
                      const Calibration& calibration = Calibration())
      : Signs(timeout_periods, service_periods),
        Calibration(calibration),
        Base(parameters),
        course_(course),
        designed_(designed),
        orders_(parameters) {
    Base::settle_at(designed_);
  }

  // ---- The control side's ----

  using Signs::serviced;

  /// Of a reading the sample that step(), hold() and pass() take.
  void calibrate(Sample& reading) const { Calibration::apply(reading); }

  /// One carrier period.
  const Drive& step(const Sample& sample) { return step(sample, look()); }

  /// What the service wants of the carrier period that begins.
  Work look() { return orders_.look(); }

  /// A carrier period with what look() gave, here or in the run that is replayed.
  const Drive& step(const Sample& sample, const Work& work) {
    Base::begin(sample);
    course_.move(static_cast<const Base&>(*this));
    if (work.stop) {
      Base::stop();
      return Base::drive();
    }
    if (work.order == nullptr) {
      watch_service();
      watch_host();
    } else if (!carry_out(*work.order)) {
      return Base::drive();
    }
    course_.aim(static_cast<Base&>(*this));
    return Base::answer(sample);
  }

  /// In place of step(), see Supervisor::hold(). A stop stays in the fault, a restart ends as tripped;
  /// other parameters are taken.
  const Drive& hold(const Sample& sample, std::uint8_t cause) {
    const Work work = look();
    Base::hold(sample, cause);
    course_.move(static_cast<const Base&>(*this));
    if (work.order == nullptr) {
      watch_service();
    } else if (work.order->kind == Kind::restart) {
      orders_.finish(OrderEnd::tripped);
    } else {
      carry_out(*work.order);
    }
    return Base::drive();
  }

  /// After the step: what the target of the next one depends on.
  template <class Board>
  void pass(const Sample& sample, Board& board) {
    course_.pass(sample, board);
  }

  /// @param target  see Controller::set_target; of a unit with a texture 0 is to follow it
  void set_target(Scalar target) {
    if (!course_.takes(target)) {
      Base::set_target(target);
    }
  }

  /// Shows the period to the service, and records it if that is asked for; after step() and trip().
  void publish() {
    ShownPeriod<Atomic>::show(static_cast<const Base&>(*this));
    trace_.record(*this);
  }

  // ---- The service's ----

  using Signs::hear_host;
  using Signs::note_service;
  using ShownPeriod<Atomic>::snapshot;

  /// Zero drive from the next carrier period on, until a restart that is ordered later.
  void order_stop() { orders_.stop(); }

  /// The orders; none while one is pending.
  /// @param faults  as many as were known when the order was given: a later fault overtakes it
  void order_restart(std::uint32_t faults) {
    orders_.draft().kind = Kind::restart;
    orders_.draft().faults = faults;
    orders_.post();
  }
  /// @param target  see Controller::set_target
  /// @param faults  as of a restart
  void order_target(Scalar target, std::uint32_t faults) {
    orders_.draft().kind = Kind::target;
    orders_.draft().faults = faults;
    orders_.draft().target = target;
    orders_.post();
  }
  /// Another controller in its place; only while the unit does not drive.
  void order_parameters(const Parameters& parameters, Scalar target, std::uint32_t timeout_periods,
                        const Calibration& calibration = Calibration()) {
    Order& order = orders_.draft();
    order.kind = Kind::parameters;
    order.target = target;
    order.timeout_periods = timeout_periods;
    order.calibration = calibration;
    order.controller = ControllerT(parameters);
    orders_.post();
  }
  /// Of the order that was given last.
  OrderEnd order_end() const { return orders_.end(); }

  /// What is recorded.
  Recorder& trace() { return trace_; }

 private:
  /// @return whether the period has its step all the same
  bool carry_out(const Order& order) {
    if (order.kind != Kind::parameters && order.faults != Base::faults().count()) {
      orders_.finish(OrderEnd::overtaken);
      return true;
    }
    switch (order.kind) {
      case Kind::restart:
        Signs::excuse_host();
        start();
        break;
      case Kind::target:
        set_target(order.target);
        trace_.take_target();
        trace_.note_target(Base::periods());
        break;
      case Kind::parameters:
        Signs::set_timeout(order.timeout_periods);
        static_cast<Calibration&>(*this) = order.calibration;
        Base::replace(order.controller);
        Base::settle_at(designed_);
        set_target(order.target);
        trace_.take_target();
        break;
    }
    const bool steps = order.kind == Kind::target;
    orders_.finish(OrderEnd::done);
    return steps;
  }

  // Out of line: in the controller it is a lot of code.
  [[gnu::noinline]] void start() { Base::restart(); }

  void watch_host() {
    if (Signs::listen() && Base::driving() && Signs::misses_host()) {
      Base::ramp_down(UnitFault::host_silent);
    }
  }

  void watch_service() {
    if (Signs::misses_service() && Base::driving()) {
      Base::trip(UnitFault::service_stalled);
    }
  }

  [[no_unique_address]] Course course_;
  const Designed& designed_;
  OrderSlot<Order, Atomic> orders_;
  [[no_unique_address]] Recorder trace_;
};

}  // namespace sonoglide::app
