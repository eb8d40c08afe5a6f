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
    loop::SnapshotWriter writer;
    engine_->save(writer);
    state.engine = writer.take();
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
    loop::SnapshotReader reader(*state.engine);
    engine().restore(reader);
    if (!reader.over()) {
      throw CallError("the state that is to be restored is too long");
    }
  }
}

std::vector<std::uint8_t> Instance::bytes_of(const State& state) const {
  loop::SnapshotWriter writer;
  writer.put(process::checksum(resources_.token));
  writer.put(state.phase);
  writer.put(state.start_s);
  writer.put(state.time_s);
  writer.put(state.inputs);
  writer.put(state.parameters.size());
  for (const auto& [reference, value] : state.parameters) {
    writer.put(reference);
    writer.put(value);
  }
  writer.put(state.engine.has_value());
  if (state.engine) {
    writer.put(state.engine->size());
    for (const std::byte byte : *state.engine) {
      writer.put(byte);
    }
  }
  const loop::Snapshot snapshot = writer.take();
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
  loop::SnapshotReader reader(snapshot);
  std::uint64_t token = 0;
  reader.get(token);
  if (token != process::checksum(resources_.token)) {
    throw CallError("the serialized state is that of another FMU");
  }
  State state;
  reader.get(state.phase);
  reader.get(state.start_s);
  reader.get(state.time_s);
  reader.get(state.inputs);
  std::size_t parameters = 0;
  reader.get(parameters);
  for (; parameters > 0; --parameters) {
    std::uint32_t reference = 0;
    reader.get(reference);
    reader.get(state.parameters[reference]);
  }
  bool has_engine = false;
  reader.get(has_engine);
  if (has_engine) {
    std::size_t size = 0;
    reader.get(size);
    state.engine.emplace(size);
    for (std::byte& byte : *state.engine) {
      reader.get(byte);
    }
  }
  return state;
}

}  // namespace sonoglide::fmi
