/// A controller in the field: what its host may ask of it.
#pragma once

#include <atomic>
#include <cstddef>
#include <cstdint>

#include "firmware/app/commanded_supervisor.hpp"
#include "firmware/app/field_parameters.hpp"
#include "firmware/app/loaded_parameters.hpp"
#include "firmware/app/self_test.hpp"
#include "firmware/link/scale_messages.hpp"
#include "firmware/store/two_page_store.hpp"

namespace sonoglide::app {

/// How a request was taken.
enum class Answer : std::uint8_t {
  taken,  ///< ordered, see Unit::order_end(); a parameter: being saved, see Unit::proceed()
  out_of_range,
  unknown_parameter,
  drive_not_stopped,
  parameters_not_confirmed,
  self_test_failed,
};

/// Supervised controller, parameters and their store. Nothing here waits.
///
/// At power-on it drives only if `start_on_power` is stored for this design. If the stored
/// parameters are damaged or of another design, the unit takes only their limits (Inheritance) and
/// waits in a fault that says so. It then refuses a restart until the parameters are confirmed or
/// one of them is written. If its self test has failed, it waits likewise, and refuses every restart.
///
/// It belongs to the service, except for its supervisor's control side (CommandedSupervisor), which may
/// interrupt every call. What a request asks of the controller is an order; the next one may be given
/// when it has ended.
///
/// @tparam Word          std::atomic; InterruptedWord where the control side is an interrupt of the only
///                       processor
/// @tparam TraceRecords  steps that its trace keeps, 2 ... 65535; 0: it has no trace. A record takes 20 bytes,
///                       of a controller with a frequency or a bias 24
/// @tparam Course        see CommandedSupervisor
/// @tparam SelfTest      ImageTest, or NoSelfTest
template <class PartsT, class Flash, template <class> class Word = std::atomic,
          std::size_t TraceRecords = 0, class Course = OrderedTargets, class SelfTest = NoSelfTest>
class Unit {
 public:
  using Design = FieldDesign<PartsT>;
  using Supervisor = CommandedSupervisor<typename Design::Controller, typename Design::Designed,
                                         Word, TraceRecords, Course>;

  /// Takes the parameters from the store, or as compiled in where it holds none.
  /// @param design     outlives the unit.
  /// @param flash      holds the store; outlives the unit.
  /// @param course     of the target, see course_of()
  /// @param self_test  how it ended; none of a unit without one, so that it costs no argument
  template <class... SelfTests>
  // NOLINTNEXTLINE(cppcoreguidelines-pro-type-member-init): the constructor that it calls does
  [[gnu::cold]] Unit(const FieldDesign<PartsT>& design, Flash& flash,
                     const Course& course = Course(), SelfTests... self_test)
      : Unit(Loaded(design, flash), design, course, self_test...) {}

  Supervisor& supervisor() { return supervisor_; }
  const Supervisor& supervisor() const { return supervisor_; }

  /// Tells this design from others.
  std::uint32_t design() const { return design_.design(); }

  /// What its codes and targets are, in SI units.
  const link::FullScales& full_scales() const { return design_.full_scales(); }

  /// Where the parameters come from: as found at reset, or stored since.
  store::Origin origin() const { return origin_; }

  /// Drive to zero until a restart. Allowed at any time, in the middle of a save too.
  void stop() { supervisor_.order_stop(); }

  /// The drive begins afresh, from a stop, from a fault or from running.
  /// @param faults  that were known when the request came: a later one overtakes it
  Answer restart(std::uint32_t faults) {
    if (!self_test_.passed()) {
      return Answer::self_test_failed;
    }
    if (!confirmed_) {
      return Answer::parameters_not_confirmed;
    }
    supervisor_.order_restart(faults);
    return Answer::taken;
  }

  /// Accepts the parameters in force until reset, and begins to save them: see write().
  Answer confirm() {
    if (supervisor_.snapshot().driving()) {
      return Answer::drive_not_stopped;
    }
    confirmed_ = true;
    pending_ = values_;
    pending_parameter_ = parameter_count;
    save();
    return Answer::taken;
  }

  /// In force from the next carrier period on, until reset.
  /// @param target  see Parameter::target, millionths.
  /// @param faults  that were known when the request came: a later one overtakes it
  Answer set_target(std::uint32_t target, std::uint32_t faults) {
    if (!range(Parameter::target).allows(target)) {
      return Answer::out_of_range;
    }
    ordered_target_ = target;
    supervisor_.trace().expect_target(target);
    supervisor_.order_target(design_.target(target), faults);
    return Answer::taken;
  }

  /// How a restart or a new target ended.
  OrderEnd order_end() {
    const OrderEnd end = supervisor_.order_end();
    if (end == OrderEnd::done) {
      target_ = ordered_target_;
    } else if (end == OrderEnd::overtaken) {
      ordered_target_ = target_;
    }
    return end;
  }

  /// See Parameter::target, millionths.
  std::uint32_t target() const { return target_; }
  /// Friction ratio, millionths; 0 where the target is a force.
  std::uint32_t target_ratio() const { return PartsT::Target::tells_ratio ? target_ : 0; }

  const ParameterRange& range(std::size_t parameter) const { return design_.range(parameter); }
  const ParameterRange& range(Parameter parameter) const {
    return range(static_cast<std::size_t>(parameter));
  }
  std::uint32_t value(std::size_t parameter) const { return values_[parameter]; }
  std::uint32_t value(Parameter parameter) const {
    return value(static_cast<std::size_t>(parameter));
  }

  /// Begins to save a value, which is in force once it is safe. A refusal changes nothing. Until
  /// proceed() has come to an end, no other request but a stop may be made.
  Answer write(std::size_t parameter, std::uint32_t value) {
    if (parameter >= parameter_count) {
      return Answer::unknown_parameter;
    }
    if (!range(parameter).allows(value)) {
      return Answer::out_of_range;
    }
    if (supervisor_.snapshot().driving()) {
      return Answer::drive_not_stopped;
    }
    pending_ = values_;
    pending_[parameter] = value;
    pending_parameter_ = parameter;
    save();
    return Answer::taken;
  }

  /// The next step of a save, once in each service; of the flash, at most one operation. A flash that
  /// takes longer than FieldDesign::save_periods() services has failed. It has ended when the
  /// controller has its new parameters.
  store::Saving proceed() {
    if (adopting_) {
      return finish_adopting();
    }
    store::Saving saving = store_.proceed();
    if (saving == store::Saving::busy && --save_periods_left_ == 0) {
      saving = store_.abandon();
    }
    if (saving == store::Saving::saved) {
      adopt();
      saving = store::Saving::busy;
    }
    return saving;
  }

 private:
  using Loaded = LoadedParameters<Design, Flash>;
  using Store = typename Loaded::Store;

  template <class... SelfTests>
  [[gnu::cold]] Unit(const Loaded& loaded, const Design& design, const Course& course,
                     SelfTests... self_test)
      : supervisor_(design.controller_parameters(loaded.values), design.designed(),
                    design.timeout_periods(loaded.values), design.service_periods(), course,
                    design.calibration(loaded.values)),
        design_(design),
        store_(loaded.store),
        values_(loaded.values),
        origin_(loaded.origin),
        self_test_(self_test...),
        target_(value(Parameter::target)) {
    supervisor_.set_target(design_.target(target_));
    supervisor_.trace().expect_target(target_);
    supervisor_.trace().take_target();
    begin();
  }

  /// What the unit does at power-on.
  void begin() {
    confirmed_ = origin_ == store::Origin::stored || origin_ == store::Origin::blank;
    if (!self_test_.passed()) {
      supervisor_.trip(UnitFault::image_damaged);
    } else if (!confirmed_) {
      supervisor_.trip(origin_ == store::Origin::damaged ? UnitFault::parameters_lost
                                                         : UnitFault::parameters_of_other_design);
    } else if (value(Parameter::start_on_power) != 0) {
      supervisor_.restart();
    }
  }

  void save() {
    typename Store::Record record{};
    for (std::size_t i = 0; i < parameter_count; ++i) {
      record[i] = {parameter_identities[i], pending_[i]};
    }
    store_.save(record);
    save_periods_left_ = design_.save_periods();
  }

  void adopt() {
    values_ = pending_;
    origin_ = store::Origin::stored;
    confirmed_ = true;
    if (pending_parameter_ == static_cast<std::size_t>(Parameter::target)) {
      target_ = value(Parameter::target);
    }
    ordered_target_ = target_;
    adopting_ = true;
    order_parameters();
  }

  [[gnu::cold, gnu::noinline]] void order_parameters() {
    supervisor_.trace().expect_target(target_);
    supervisor_.order_parameters(design_.controller_parameters(values_), design_.target(target_),
                                 design_.timeout_periods(values_), design_.calibration(values_));
  }

  /// What is saved is in force in the end, whatever stops come in between.
  store::Saving finish_adopting() {
    switch (supervisor_.order_end()) {
      case OrderEnd::pending:
        return store::Saving::busy;
      case OrderEnd::overtaken:
      case OrderEnd::tripped:  // never of parameters
        order_parameters();
        return store::Saving::busy;
      case OrderEnd::done:
        break;
    }
    adopting_ = false;
    return store::Saving::saved;
  }

  // First: small processors reach what is near the beginning by fewer instructions.
  Supervisor supervisor_;
  const Design& design_;
  Store store_;
  ParameterValues values_;
  store::Origin origin_;
  [[no_unique_address]] SelfTest self_test_;
  bool confirmed_ = false;  ///< nothing speaks against the parameters, or somebody took them
  std::uint32_t target_;
  std::uint32_t ordered_target_ = target_;
  bool adopting_ = false;  ///< what was saved is ordered
  ParameterValues pending_{};
  std::size_t pending_parameter_ = 0;
  std::uint32_t save_periods_left_ = 0;
};

template <class PartsT, class Flash, class Course, class SelfTest>
Unit(const FieldDesign<PartsT>&, Flash&, const Course&, SelfTest)
    -> Unit<PartsT, Flash, std::atomic, 0, Course, SelfTest>;

}  // namespace sonoglide::app
