/// What a sweep computes: a scene, and how each of its points differs from it.
#pragma once

#include <cstddef>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "host_sim/long_work/pace.hpp"
#include "host_sim/long_work/shard.hpp"
#include "host_sim/scene/scene.hpp"
#include "host_sim/scene_file/document.hpp"
#include "host_sim/scene_file/scene_error.hpp"
#include "host_sim/scene_file/source.hpp"
#include "host_sim/scene_file/variant.hpp"
#include "host_sim/studies/sweep/axis.hpp"

namespace sonoglide::sweep {

using long_work::PointRange;

/// The scene file is read once: a later edit of it does not reach into a sweep under way.
class Plan {
 public:
  /// @param overrides  `TABLE.KEY=VALUE` each, for every point
  /// @param vary       `KEY=FROM:TO:COUNT[:log]` or `KEY=A,B,...` each, see parse_axis()
  /// @param most       points
  /// @throws scene_file::SceneError  a bad option, a key both varied and set, an unusable first
  ///         point, where words are varied, a key that is of no use with any of them
  Plan(scene_file::Source source, std::vector<std::string> overrides, std::vector<std::string> vary,
       std::size_t most = most_points);

  const scene_file::Source& source() const { return source_; }
  const std::vector<std::string>& overrides() const { return overrides_; }
  const std::vector<std::string>& vary() const { return vary_; }

  const Grid& grid() const { return grid_; }
  PointRange all() const { return {0, grid_.size()}; }
  /// The scene of the first point.
  const scene::Scene& first() const { return first_; }
  bool closed_loop() const { return first_.controller.has_value(); }

  /// The points that take each combination of the varied words once, with the first of all numbers.
  std::vector<std::size_t> wordings() const;

  /// The scene of a point, the same as `run` takes it with a --set for each varied key; nothing is
  /// recorded. Where words are varied, a key that the point's words have no use for is left out.
  /// Safe to call from several threads.
  /// @throws scene_file::SceneError  at the place of the --vary option or in the scene; the message
  ///         ends with the point
  scene::Scene scene(std::size_t point) const;

  /// Takes the scene of a point; called by several threads.
  using Visit = std::function<void(std::size_t point, const scene::Scene& scene)>;

  /// Reads the scenes of these points, on all threads.
  /// @param pace  its stage is the reading; may be null
  /// @throws scene_file::SceneError  the error of the first unusable point
  void visit(const PointRange& points, const Visit& visit, long_work::Pace* pace = nullptr) const;

  /// `KEY=VALUE, KEY=VALUE`, in the order of the axes.
  std::string describe(std::size_t point) const;

 private:
  std::vector<std::string> varied_keys() const;
  std::vector<scene_file::VariedValue> values_of(std::size_t point) const;
  scene::Scene read(std::size_t point) const;
  scene::Scene read(std::size_t point, scene_file::UnusedKeys* unused) const;
  void set_velocity(scene::Scene& scene, std::size_t point, std::size_t axis) const;
  void require_varied_once() const;
  void require_used() const;
  [[noreturn]] void fail_at_point(const scene_file::SceneError& error, std::size_t point) const;

  scene_file::Source source_;
  std::vector<std::string> overrides_;
  std::vector<std::string> vary_;
  Grid grid_;
  bool has_words_ = false;
  std::optional<scene_file::Document> document_;  ///< from the constructor on
  scene::Scene first_;
};

}  // namespace sonoglide::sweep
