#include "host_sim/scene_file/value_reader.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "host_sim/configure/bound.hpp"

namespace sonoglide::scene_file {

void ValueReader::refuse_integer(std::string_view key, int value,
                                 const std::vector<int>& allowed) const {
  cursor_.fail(key, fmt::format("{} is not built; allowed: {}", value, fmt::join(allowed, ", ")));
}

void ValueReader::time(std::string_view key, std::string_view periods_key, double& time_s,
                       const std::optional<scene::Drive>& drive) {
  const std::string_view found = cursor_.one_of(key, periods_key);
  if (found == key) {
    time_s = cursor_.real(key);
    return;
  }
  if (!drive) {
    cursor_.fail(found, "there is no period without a [drive] table; allowed: the time in s");
  }
  time_s = cursor_.real(found) / drive->frequency_Hz;
}

scene::TimedProfile ValueReader::timed(std::string_view key, const Profile& allowed) {
  scene::TimedProfile profile;
  for (const auto& [time_s, value] :
       cursor_.timed_values_in(key, allowed, TableCursor::Times::jump)) {
    profile.push_back({time_s, value});
  }
  return profile;
}

void ValueReader::level(const Level& level, ZeroIn zero, std::optional<double> absent) {
  if (cursor_.one_of(level.key, level.profile_key) == level.key) {
    level.value = cursor_.real_in(level.key, cursor_.allowed<Number>(level.key).range, absent);
    return;
  }
  Profile allowed = cursor_.allowed<Profile>(level.profile_key);
  allowed.value.low_open = zero == ZeroIn::value_only;
  level.profile = timed(level.profile_key, allowed);
  level.value = scene::value_at(level.profile, 0.0);
}

void ValueReader::speed(std::string_view key, std::string_view profile_key,
                        std::vector<scene::SpeedPoint>& points) {
  if (cursor_.one_of(key, profile_key) == key) {
    points.push_back({0.0, cursor_.real(key)});
    return;
  }
  for (const auto& [time_s, velocity_m_per_s] : cursor_.timed_values(profile_key)) {
    points.push_back({time_s, velocity_m_per_s});
  }
}

void ValueReader::targets(std::string_view key, std::vector<scene::TargetStep>& steps) {
  for (const auto& [time_s, friction_ratio] : cursor_.timed_values(key)) {
    steps.push_back({time_s, friction_ratio});
  }
  if (steps.front().time_s != 0.0) {
    cursor_.fail(key,
                 fmt::format("begins at {} s; allowed: a first time of 0 s", steps.front().time_s));
  }
}

void ValueReader::refuse(std::string_view key, double parameter, std::string_view finding,
                         double least, std::string_view rest) {
  cursor_.fail(key, fmt::format("{} {}; allowed: at least {} {}", parameter, finding,
                                configure::at_least(least), rest));
}

}  // namespace sonoglide::scene_file
