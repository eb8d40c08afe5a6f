/// A controller in the field: what its host may ask of it.
#pragma once

#include <cstddef>
#include <cstdint>

#include "firmware/app/field_parameters.hpp"
#include "firmware/app/host_ramp.hpp"
#include "firmware/app/supervisor.hpp"
#include "firmware/store/two_page_store.hpp"

namespace sonoglide::app {

/// How a request was taken.
enum class Answer : std::uint8_t {
  taken,  ///< done; a parameter: being saved, see Unit::proceed()
  out_of_range,
  unknown_parameter,
  drive_not_stopped,
  parameters_not_confirmed,
};

/// Supervised controller, parameters and their store. Nothing here waits.
///
/// At power-on it drives only if `start_on_power` is stored for this design. If the stored
/// parameters are damaged or of another design, the unit takes only their limits (Inheritance) and
/// waits in a fault that says so. It then refuses a restart until the parameters are confirmed or
/// one of them is written.
///
/// A service tells it of every carrier period and of every sign of life from the host. If the host
/// is silent for longer than `host_timeout` while the unit drives, the unit is in the fault
/// host_silent, and the drive ramps down (HostRamp). A restart ends this fault, like any other.
template <class PartsT, class Flash>
class Unit {
 public:
  using Design = FieldDesign<PartsT>;
  using Supervisor = app::Supervisor<typename Design::Controller, HostRamp>;

  /// Takes the parameters from the store, or as compiled in where it holds none.
  /// @param design  outlives the unit.
  /// @param flash   holds the store; outlives the unit.
  Unit(const FieldDesign<PartsT>& design, Flash& flash)
      : design_(design),
        store_(flash, design.design()),
        values_(design.presets()),
        origin_(load()),
        timeout_periods_(design.timeout_periods(values_)),
        target_(value(Parameter::target)),
        supervisor_(design.controller_parameters(values_)) {
    supervisor_.settle_at(design_.designed());
    apply_target();
    begin();
  }

  Supervisor& supervisor() { return supervisor_; }
  const Supervisor& supervisor() const { return supervisor_; }

  /// Where the parameters come from: as found at reset, or stored since.
  store::Origin origin() const { return origin_; }

  /// Drive to zero until a restart. Allowed at any time, in the middle of a save too.
  void stop() { supervisor_.stop(); }

  /// The drive begins afresh, from a stop, from a fault or from running.
  Answer restart() {
    if (!confirmed_) {
      return Answer::parameters_not_confirmed;
    }
    silent_periods_ = 0;
    start_drive();
    return Answer::taken;
  }

  /// Accepts the parameters in force until reset, and begins to save them: see write().
  Answer confirm() {
    if (supervisor_.driving()) {
      return Answer::drive_not_stopped;
    }
    confirmed_ = true;
    pending_ = values_;
    pending_parameter_ = parameter_count;
    save();
    return Answer::taken;
  }

  /// The host gave a sign of life.
  void hear_host() { silent_periods_ = 0; }

  /// Once in each carrier period.
  void count_silence() {
    if (timeout_periods_ != 0 && supervisor_.driving() && silent_periods_++ >= timeout_periods_) {
      supervisor_.ramp_down(UnitFault::host_silent);
    }
  }

  /// In force from the next carrier period on, until reset.
  /// @param ratio  friction ratio, millionths.
  Answer set_target(std::uint32_t ratio) {
    if (!range(Parameter::target).allows(ratio)) {
      return Answer::out_of_range;
    }
    target_ = ratio;
    apply_target();
    return Answer::taken;
  }

  /// Friction ratio, millionths.
  std::uint32_t target() const { return target_; }

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
    if (supervisor_.driving()) {
      return Answer::drive_not_stopped;
    }
    pending_ = values_;
    pending_[parameter] = value;
    pending_parameter_ = parameter;
    save();
    return Answer::taken;
  }

  /// The next step of a save, once in each carrier period; of the flash, at most one operation. A
  /// flash that takes longer than FieldDesign::save_periods() has failed.
  store::Saving proceed() {
    store::Saving saving = store_.proceed();
    if (saving == store::Saving::busy && --save_periods_left_ == 0) {
      saving = store_.abandon();
    }
    if (saving == store::Saving::saved) {
      adopt();
    }
    return saving;
  }

 private:
  using Store = store::TwoPageStore<Flash, parameter_count>;

  store::Origin load() {
    const store::Origin origin = store_.load();
    if (origin == store::Origin::stored && take_all()) {
      return origin;
    }
    take_limits();
    return origin == store::Origin::stored ? store::Origin::damaged : origin;
  }

  /// @return false, and nothing taken, unless each parameter is there and within its range.
  bool take_all() {
    ParameterValues stored{};
    for (std::size_t i = 0; i < parameter_count; ++i) {
      if (!store_.find(parameter_identities[i], stored[i])) {
        return false;
      }
    }
    const bool allowed = design_.allows(stored);
    values_ = allowed ? stored : values_;
    return allowed;
  }

  void take_limits() {
    for (std::size_t i = 0; i < parameter_count; ++i) {
      std::uint32_t stored = 0;
      if (store_.find(parameter_identities[i], stored)) {
        values_[i] = range(i).inherited(stored);
      }
    }
  }

  /// What the unit does at power-on.
  void begin() {
    confirmed_ = origin_ == store::Origin::stored || origin_ == store::Origin::blank;
    if (!confirmed_) {
      supervisor_.trip(origin_ == store::Origin::damaged ? UnitFault::parameters_lost
                                                         : UnitFault::parameters_of_other_design);
    } else if (value(Parameter::start_on_power) != 0) {
      start_drive();
    }
  }

  // Out of line: in the controller they are a lot of code.
  [[gnu::noinline]] void apply_target() { supervisor_.set_target(design_.half_target(target_)); }
  [[gnu::noinline]] void start_drive() { supervisor_.restart(); }

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
    timeout_periods_ = design_.timeout_periods(values_);
    supervisor_.reconfigure(design_.controller_parameters(values_));
    supervisor_.settle_at(design_.designed());
    if (pending_parameter_ == static_cast<std::size_t>(Parameter::target)) {
      target_ = value(Parameter::target);
    }
    apply_target();
  }

  const Design& design_;
  Store store_;
  ParameterValues values_;
  store::Origin origin_;
  bool confirmed_ = false;  ///< nothing speaks against the parameters, or somebody took them
  std::uint32_t timeout_periods_;
  std::uint32_t silent_periods_ = 0;
  std::uint32_t target_;
  ParameterValues pending_{};
  std::size_t pending_parameter_ = 0;
  std::uint32_t save_periods_left_ = 0;
  Supervisor supervisor_;
};

}  // namespace sonoglide::app
