#include "host_sim/long_work/work.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <nlohmann/json.hpp>

#include "host_sim/process/checksum.hpp"

namespace sonoglide::long_work {
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
