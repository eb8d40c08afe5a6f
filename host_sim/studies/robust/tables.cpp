#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "host_sim/output/number.hpp"
#include "host_sim/output/program.hpp"
#include "host_sim/scene_file/echo.hpp"
#include "host_sim/studies/robust/report.hpp"

namespace sonoglide::robust {

const std::vector<Figure>& figures() {
  static const std::vector<Figure> all = {
      {"settling_time_s", "Settling time [s]", &PlantRow::settling_time_s, "never"},
      {"overshoot", "Overshoot [-]", &PlantRow::overshoot, "-"},
      {"steady_error", "Steady error [-]", &PlantRow::steady_error, "-"},
      {"ripple", "Ripple [-]", &PlantRow::ripple, "-"}};
  return all;
}

std::string counted(std::size_t count, const char* noun) {
  return fmt::format("{} {}{}", count, noun, count == 1 ? "" : "s");
}

std::vector<double> values_of(const Study& study, const Figure& figure) {
  constexpr double nothing = 1e-14;  // of a friction ratio; times are far longer
  std::vector<double> values;
  values.reserve(study.samples.size());
  for (const PlantRow& row : study.samples) {
    const double value = row.*figure.value;
    values.push_back(std::abs(value) < nothing ? 0.0 : value);
  }
  return values;
}

std::vector<double> factors_of(const Task& task, std::size_t tolerance) {
  std::vector<double> values;
  values.reserve(task.counts().samples);
  for (std::size_t i = 0; i < task.counts().samples; ++i) {
    values.push_back(task.sample(i)[tolerance]);
  }
  return values;
}

std::vector<std::vector<Importance>> importance(const Task& task, const Study& study) {
  std::vector<Ranks> ranks_of_figures;
  for (const Figure& figure : figures()) {
    ranks_of_figures.emplace_back(values_of(study, figure));
  }
  std::vector<std::vector<Importance>> result;
  for (std::size_t i = 0; i < task.tolerances().size(); ++i) {
    const Ranks factors(factors_of(task, i));
    std::vector<Importance>& of_key = result.emplace_back();
    for (const Ranks& values : ranks_of_figures) {
      of_key.push_back({rank_correlation(factors, values), main_effect(factors, values)});
    }
  }
  return result;
}

std::vector<NameCount> count_names(const Study& study,
                                   std::vector<std::string> (*names)(const PlantRow&)) {
  std::map<std::string, std::size_t> counts;
  for (const PlantRow& row : study.samples) {
    for (const std::string& name : names(row)) {
      ++counts[name];
    }
  }
  std::vector<NameCount> all;
  all.reserve(counts.size());
  for (const auto& [name, count] : counts) {
    all.push_back({name, count});
  }
  std::stable_sort(all.begin(), all.end(),
                   [](const NameCount& a, const NameCount& b) { return a.count > b.count; });
  return all;
}

namespace {

std::string words(const std::vector<std::string>& names) {
  return names.empty() ? "none" : fmt::format("{}", fmt::join(names, " "));
}

void write_heading(std::ostream& out, const Task& task) {
  for (const scene::Tolerance& each : task.tolerances()) {
    out << each.key << ',';
  }
  for (const Figure& figure : figures()) {
    out << figure.key << ',';
  }
  out << "deviation,never_settled,limits,faults,failed,trace_hash,status\n";
}

void write_line(std::ostream& out, const Factors& factors, const PlantRow& row) {
  for (const double factor : factors) {
    out << output::csv_number(factor) << ',';
  }
  for (const Figure& figure : figures()) {
    out << output::csv_number(row.*figure.value) << ',';
  }
  out << fmt::format("{},{},{},{},{},{:016x},{}\n", output::csv_number(row.deviation),
                     row.unsettled, words(limit_names(row)), words(fault_names(row)),
                     row.failed() ? "yes" : "no", row.trace_hash, output::csv_cell(row.status));
}

}  // namespace

void write_samples(std::ostream& out, const Task& task, const Study& study) {
  out << "sample,";
  write_heading(out, task);
  for (std::size_t i = 0; i < study.samples.size(); ++i) {
    out << i << ',';
    write_line(out, task.sample(i), study.samples[i]);
  }
}

void write_search(std::ostream& out, const Task& task, const Study& study) {
  out << "climb,";
  write_heading(out, task);
  for (const SearchRun& each : study.search) {
    out << each.climb << ',';
    write_line(out, each.factors, each.row);
  }
}

namespace {

using nlohmann::ordered_json;

ordered_json counts_json(const std::vector<NameCount>& names) {
  ordered_json json = ordered_json::object();
  for (const NameCount& each : names) {
    json[each.name] = each.count;
  }
  return json;
}

ordered_json worst_json(const Task& task, const WorstPlant& worst) {
  ordered_json json;
  json["found_by"] = worst.found_by;
  for (std::size_t i = 0; i < worst.factors.size(); ++i) {
    json["factors"][task.tolerances()[i].key] = worst.factors[i];
  }
  for (const Figure& figure : figures()) {
    json[figure.key] = output::json_number(worst.row.*figure.value);
  }
  json["deviation"] = output::json_number(worst.row.deviation);
  json["never_settled"] = worst.row.unsettled;
  json["limits"] = limit_names(worst.row);
  json["faults"] = fault_names(worst.row);
  json["failed"] = worst.row.failed();
  json["trace_hash"] = fmt::format("{:016x}", worst.row.trace_hash);
  json["status"] = worst.row.status;
  return json;
}

void add_importance(ordered_json& json, const Task& task, const Study& study) {
  const std::vector<std::vector<Importance>> found = importance(task, study);
  for (std::size_t i = 0; i < found.size(); ++i) {
    ordered_json& of_key = json[task.tolerances()[i].key];
    for (std::size_t k = 0; k < found[i].size(); ++k) {
      of_key[figures()[k].key] = {
          {"rank_correlation", output::json_number(found[i][k].rank_correlation)},
          {"main_effect", output::json_number(found[i][k].main_effect)}};
    }
  }
}

std::size_t count_if(const Study& study, bool (*holds)(const PlantRow&)) {
  return static_cast<std::size_t>(std::count_if(study.samples.begin(), study.samples.end(), holds));
}

}  // namespace

ordered_json to_json(const Task& task, const Study& study) {
  const std::size_t samples = study.samples.size();
  const std::size_t failures = study.failures();
  ordered_json json;
  json["program"] = output::program_json();
  json["scene"] = scene_file::to_json(task.nominal());
  json["seed"] = task.counts().seed;
  json["samples"] = samples;
  json["failures"] = failures;
  json["failure_fraction"] = static_cast<double>(failures) / static_cast<double>(samples);
  json["failure_probability_upper_95"] = failure_probability_upper(failures, samples, 0.95);
  json["failure_probability_upper_99"] = failure_probability_upper(failures, samples, 0.99);
  json["failure_probability_upper_99_9"] = failure_probability_upper(failures, samples, 0.999);
  json["with_fault"] = count_if(study, [](const PlantRow& row) { return row.faults != 0; });
  json["never_settled"] = count_if(study, [](const PlantRow& row) { return row.unsettled != 0; });
  json["not_computed"] = count_if(study, [](const PlantRow& row) { return !row.ok(); });
  for (const Figure& figure : figures()) {
    const Quantiles found = quantiles(values_of(study, figure));
    json[figure.key] = {{"median", output::json_number(found.median)},
                        {"p95", output::json_number(found.p95)},
                        {"p99", output::json_number(found.p99)},
                        {"worst", output::json_number(found.worst)}};
  }
  json["limits"] = counts_json(count_names(study, limit_names));
  json["faults"] = counts_json(count_names(study, fault_names));
  add_importance(json["importance"], task, study);
  json["notes"] = task.notes();
  json["search"] = {{"runs", study.search.size()}, {"failures", study.search_failures()}};
  json["worst"] = worst_json(task, study.worst);
  return json;
}

}  // namespace sonoglide::robust
