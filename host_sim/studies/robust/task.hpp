/// What a robustness study computes: the plants that the tolerances of a scene allow.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "host_sim/configure/control_design.hpp"
#include "host_sim/configure/read/experiment.hpp"
#include "host_sim/scene/scene.hpp"
#include "host_sim/scene_file/document.hpp"
#include "host_sim/scene_file/source.hpp"

namespace sonoglide::robust {

inline constexpr std::size_t most_samples = 1'000'000;

struct Counts {
  std::size_t samples = 1024;  ///< 1 to most_samples; a power of two fills the tolerances best
  std::size_t search = 256;    ///< runs that the search may take, at most; 0: none
  std::uint64_t seed = 1;
};

/// A true value for each tolerance, in the order of the scene.
using Factors = std::vector<double>;

class Task {
 public:
  /// @param overrides  `TABLE.KEY=VALUE` each
  /// @throws scene_file::SceneError  the scene is unusable, open loop, or without a tolerance
  Task(scene_file::Source source, std::vector<std::string> overrides, const Counts& counts);

  const scene_file::Source& source() const { return source_; }
  const std::vector<std::string>& overrides() const { return overrides_; }
  const Counts& counts() const { return counts_; }
  const scene::Scene& nominal() const { return own_.nominal; }
  /// That of the scene itself.
  const scene::Scene& own_plant() const { return own_.plant; }
  const std::vector<scene::Tolerance>& tolerances() const { return nominal().tolerances; }
  const configure::ControlDesign& design() const { return *own_.design; }
  /// What a user should know of the controller's design and of the tolerances, a sentence or more
  /// each.
  std::vector<std::string> notes() const;

  /// Of a sample, in [0, samples).
  Factors sample(std::size_t index) const;

  /// The scene whose true values are these; nothing is recorded. Safe to call from several threads.
  /// @throws scene_file::SceneError  at the tolerance: together they are those of no plant
  scene::Scene plant(const Factors& factors) const;

  /// `KEY = VALUE, KEY = VALUE`.
  std::string describe(const Factors& factors) const;

  /// The plant as a scene file, which records what the scene does.
  std::string plant_text(const Factors& factors) const;

 private:
  scene::Scene read_plant(const Factors& factors) const;
  [[noreturn]] void fail_at(const scene_file::SceneError& error, const Factors& factors) const;

  scene_file::Source source_;
  std::vector<std::string> overrides_;
  Counts counts_;
  scene_file::Document stated_;
  experiment::Experiment own_;
  std::optional<scene_file::Document> document_;  ///< with a varied true value for each tolerance
  std::vector<double> points_;
};

}  // namespace sonoglide::robust
