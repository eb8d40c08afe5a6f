#include "host_sim/long_work/shard.hpp"

#include <fmt/format.h>

#include <charconv>
#include <cstddef>
#include <system_error>

namespace sonoglide::long_work {
namespace {

/// Takes a number of at most most_shards, without a sign or a zero before it, off the front.
std::optional<std::uint64_t> take_number(std::string_view& text) {
  std::uint64_t value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc() || text.front() == '0' || value > most_shards) {
    return std::nullopt;
  }
  text.remove_prefix(static_cast<std::size_t>(end - text.data()));
  return value;
}

bool take(std::string_view& text, std::string_view word) {
  const bool there = text.substr(0, word.size()) == word;
  text.remove_prefix(there ? word.size() : 0);
  return there;
}

std::optional<Shard> take_shard(std::string_view& text, std::string_view between) {
  const auto number = take_number(text);
  if (!number || !take(text, between)) {
    return std::nullopt;
  }
  const auto count = take_number(text);
  return count && *number <= *count ? std::optional<Shard>({*number, *count}) : std::nullopt;
}

std::string stem(const Shard& shard) {
  return fmt::format("shard_{}_of_{}", shard.number, shard.count);
}

constexpr std::string_view rows_ending = ".rows";
constexpr std::string_view journal_ending = ".journal";

}  // namespace

PointRange Shard::range(std::uint64_t points) const {
  return {(number - 1) * points / count, number * points / count};
}

std::optional<Shard> parse_shard(std::string_view text) {
  const std::optional<Shard> shard = take_shard(text, "/");
  return text.empty() ? shard : std::nullopt;
}

std::string rows_name(const Shard& shard) {
  return fmt::format("{}{}", stem(shard), rows_ending);
}

std::string journal_name(const Shard& shard, const std::string& copy) {
  return fmt::format("{}.{}{}", stem(shard), copy, journal_ending);
}

std::string staged_name(const Shard& shard, const std::string& copy) {
  return fmt::format(".{}.{}", rows_name(shard), copy);
}

std::string copy_of(const Shard& shard, const std::string& name) {
  const std::size_t begin = stem(shard).size() + 1;
  return name.substr(begin, name.size() - journal_ending.size() - begin);
}

std::optional<ShardFileName> parse_file_name(std::string_view name) {
  if (!take(name, "shard_")) {
    return std::nullopt;
  }
  const std::optional<Shard> shard = take_shard(name, "_of_");
  if (!shard) {
    return std::nullopt;
  }
  if (name == rows_ending) {
    return ShardFileName{*shard, ShardFileName::Kind::rows};
  }
  const bool journal = name.size() > journal_ending.size() + 1 && name.front() == '.' &&
                       name.substr(name.size() - journal_ending.size()) == journal_ending;
  return journal ? std::optional<ShardFileName>({*shard, ShardFileName::Kind::journal})
                 : std::nullopt;
}

}  // namespace sonoglide::long_work
