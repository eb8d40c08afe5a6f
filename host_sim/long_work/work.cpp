#include "host_sim/long_work/work.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <nlohmann/json.hpp>

#include <charconv>
#include <cstddef>
#include <system_error>

#include "host_sim/process/checksum.hpp"

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

namespace {

constexpr const char* format = "sonoglide shard, format 1";

}  // namespace

std::string header_text(const ShardHeader& header) {
  const Work& work = header.work;
  const nlohmann::ordered_json json = {{"format", format},
                                       {"kind", work.kind},
                                       {"program", work.program},
                                       {"arithmetic", work.arithmetic},
                                       {"name", work.name},
                                       {"scene", work.scene},
                                       {"overrides", work.overrides},
                                       {"options", work.options},
                                       {"points", work.points},
                                       {"shards", work.shards},
                                       {"shard", header.number}};
  return json.dump(-1, ' ', false, nlohmann::ordered_json::error_handler_t::replace);
}

std::optional<ShardHeader> parse_header(std::string_view text) try {
  const auto json = nlohmann::ordered_json::parse(text);
  if (json.at("format") != format) {
    return std::nullopt;
  }
  return ShardHeader{{json.at("kind"), json.at("program"), json.at("arithmetic"), json.at("name"),
                      json.at("scene"), json.at("overrides"), json.at("options"), json.at("points"),
                      json.at("shards")},
                     json.at("shard")};
} catch (const nlohmann::ordered_json::exception&) {
  return std::nullopt;
}

Difference difference(const Work& one, const Work& other) {
  const auto told = [](const char* what, const auto& a, const auto& b) {
    return Difference{fmt::format("{} {}", what, a), fmt::format("{} {}", what, b)};
  };
  const auto words = [](const std::vector<std::string>& all) {
    return fmt::format("\"{}\"", fmt::join(all, " "));
  };
  if (one.kind != other.kind) {
    return told("kind", one.kind, other.kind);
  }
  if (one.program != other.program) {
    return told("program", one.program, other.program);
  }
  if (one.arithmetic != other.arithmetic) {
    return told("arithmetic", one.arithmetic, other.arithmetic);
  }
  if (one.shards != other.shards) {
    return told("number of shards", one.shards, other.shards);
  }
  if (one.options != other.options) {
    return told("options", words(one.options), words(other.options));
  }
  if (one.overrides != other.overrides) {
    return told("--set", words(one.overrides), words(other.overrides));
  }
  if (one.scene != other.scene) {
    const auto sum = [](const std::string& text) {
      return fmt::format("of checksum {:016x}", process::checksum(text));
    };
    return told("a scene", sum(one.scene), sum(other.scene));
  }
  if (one.name != other.name) {
    return told("scene", one.name, other.name);
  }
  return one.points != other.points ? told("points", one.points, other.points) : Difference{};
}

}  // namespace sonoglide::long_work
