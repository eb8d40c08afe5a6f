#include <cstring>

#include "host_sim/fmi/instance.hpp"
#include "host_sim/process/checksum.hpp"

namespace sonoglide::fmi {
namespace {

std::string_view as_text(const std::uint8_t* bytes, std::size_t count) {
  return {reinterpret_cast<const char*>(bytes), count};
}

}  // namespace

State Instance::save() {
  State state = now_;
  if (engine_) {
    loop::StateCopy copy;
    engine_->copy_state(copy);
    state.engine = copy.take();
  }
  return state;
}

void Instance::restore(const State& state) {
  const bool same_numbers = state.parameters == now_.parameters;
  now_ = state;
  now_.engine.reset();
  if (!state.engine || !same_numbers) {
    engine_.reset();
  }
  if (state.engine) {
    loop::StateCopy copy(*state.engine);
    engine().copy_state(copy);
    if (!copy.over()) {
      throw CallError("the state that is to be restored is too long");
    }
  }
}

void Instance::copy_parts(loop::StateCopy& copy, State& state) const {
  std::uint64_t token = process::checksum(resources_.token);
  copy(token);
  if (token != process::checksum(resources_.token)) {
    throw CallError("the serialized state is that of another FMU");
  }
  std::size_t parameters = state.parameters.size();
  copy(state.phase, state.range, state.time_s, state.inputs, parameters);
  for (auto next = state.parameters.begin(); parameters > 0; --parameters) {
    std::uint32_t reference = copy.is_back() ? 0 : next++->first;
    copy(reference);
    copy(state.parameters[reference]);
  }
  bool has_engine = state.engine.has_value();
  copy(has_engine);
  if (has_engine) {
    loop::Snapshot& engine = state.engine ? *state.engine : state.engine.emplace();
    std::size_t size = engine.size();
    copy(size);
    engine.resize(size);
    for (std::byte& byte : engine) {
      copy(byte);
    }
  }
}

std::vector<std::uint8_t> Instance::bytes_of(State state) const {
  loop::StateCopy copy;
  copy_parts(copy, state);
  const loop::Snapshot snapshot = copy.take();
  std::vector<std::uint8_t> bytes(snapshot.size() + sizeof(std::uint64_t));
  std::memcpy(bytes.data(), snapshot.data(), snapshot.size());
  const std::uint64_t sum = process::checksum(as_text(bytes.data(), snapshot.size()));
  std::memcpy(bytes.data() + snapshot.size(), &sum, sizeof(sum));
  return bytes;
}

State Instance::state_of(const std::uint8_t* bytes, std::size_t count) const {
  std::uint64_t sum = 0;
  if (count < sizeof(sum)) {
    throw CallError("the serialized state is too short");
  }
  const std::size_t rest = count - sizeof(sum);
  std::memcpy(&sum, bytes + rest, sizeof(sum));
  if (sum != process::checksum(as_text(bytes, rest))) {
    throw CallError("the serialized state is damaged");
  }
  loop::Snapshot snapshot(rest);
  std::memcpy(snapshot.data(), bytes, rest);
  loop::StateCopy copy(snapshot);
  State state;
  copy_parts(copy, state);
  return state;
}

}  // namespace sonoglide::fmi
