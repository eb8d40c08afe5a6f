/// Reads into a scene the values that its keys hold.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "host_sim/scene/names.hpp"
#include "host_sim/scene/scene.hpp"
#include "host_sim/scene_file/scene_values.hpp"
#include "host_sim/scene_file/table_cursor.hpp"

namespace sonoglide::scene_file {

/// The `Keys` of scene_values.hpp for one table. Every call throws SceneError as TableCursor does.
class ValueReader {
 public:
  explicit ValueReader(TableCursor& cursor) : cursor_(cursor) {}

  void value(std::string_view key, double& value) { value = cursor_.real(key); }
  void value(std::string_view key, double& value, double absent) {
    value = cursor_.real(key, absent);
  }
  void value(std::string_view key, std::optional<double>& value) {
    value = cursor_.optional_real(key);
  }
  void value(std::string_view key, int& value) { value = static_cast<int>(cursor_.integer(key)); }
  void value(std::string_view key, std::optional<int>& value) {
    const std::optional<std::int64_t> integer = cursor_.optional_integer(key);
    value = integer ? std::optional<int>(static_cast<int>(*integer)) : std::nullopt;
  }
  void value(std::string_view key, std::uint64_t& value) {
    value = static_cast<std::uint64_t>(cursor_.integer(key));
  }
  void value_in(std::string_view key, double& value, const Range& range) {
    value = cursor_.real_in(key, range, value);
  }
  void value_or_0(std::string_view key, double& value) { value = cursor_.real(key, 0.0); }

  template <class Value, std::size_t Count>
  void word(std::string_view key, Value& value,
            const std::array<scene::Named<Value>, Count>& names) {
    value = cursor_.choice(key, names);
  }
  template <class Value, std::size_t Count>
  void words(std::string_view key, std::vector<Value>& values,
             const std::array<scene::Named<Value>, Count>& names) {
    values = cursor_.choices(key, names);
  }

  template <class Value, std::size_t Count>
  void optional_word(std::string_view key, std::optional<Value>& value,
                     const std::array<scene::Named<Value>, Count>& names) {
    const std::optional<std::size_t> index = cursor_.optional_word(key);
    value = index ? std::optional(names[*index].value) : std::nullopt;
  }
  void truth(std::string_view key, bool& value) { value = cursor_.truth(key); }
  void range(std::string_view key, std::optional<scene::FrequencyRange>& range) {
    if (const auto found = cursor_.optional_interval(key)) {
      range = {(*found)[0], (*found)[1]};
    }
  }

  template <class Integers>
  void one_of(std::string_view key, std::optional<int>& chosen, const Integers& allowed) {
    value(key, chosen);
    if (chosen && std::find(allowed.begin(), allowed.end(), *chosen) == allowed.end()) {
      refuse_integer(key, *chosen, {allowed.begin(), allowed.end()});
    }
  }

  /// Leaves the value as it is where both keys are absent and the first need not be there.
  void time(std::string_view key, std::string_view periods_key, double& time_s,
            const std::optional<scene::Drive>& drive);
  void level(const Level& level, ZeroIn zero, std::optional<double> absent);
  void profile(std::string_view key, scene::TimedProfile& profile) {
    if (cursor_.has(key)) {
      profile = timed(key, cursor_.allowed<Profile>(key));
    }
  }
  void speed(std::string_view key, std::string_view profile_key,
             std::vector<scene::SpeedPoint>& points);
  void targets(std::string_view key, std::vector<scene::TargetStep>& steps);

  void required(std::string_view key, double& parameter, const Range& range,
                std::string_view /*meaning*/) {
    parameter = cursor_.real_in(key, range);
  }
  void optional(std::string_view key, double& parameter, const Range& range,
                std::string_view /*meaning*/) {
    parameter = cursor_.real_in(key, range, parameter);
  }
  void optional(std::string_view key, int& count, int least, int most,
                std::string_view /*meaning*/) {
    count = static_cast<int>(cursor_.integer_in(key, {least, most}, count));
  }
  void refuse(std::string_view key, double parameter, std::string_view finding, double least,
              std::string_view rest);

 private:
  scene::TimedProfile timed(std::string_view key, const Profile& allowed);
  [[noreturn]] void refuse_integer(std::string_view key, int value,
                                   const std::vector<int>& allowed) const;

  TableCursor& cursor_;
};

}  // namespace sonoglide::scene_file
