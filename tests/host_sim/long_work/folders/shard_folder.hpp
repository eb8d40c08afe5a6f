/// A folder of shards that are made by hand.
#pragma once

#include <filesystem>
#include <fstream>
#include <iterator>
#include <stdexcept>
#include <string>

#include "host_sim/long_work/record.hpp"
#include "host_sim/long_work/rows_file.hpp"
#include "host_sim/long_work/work.hpp"
#include "host_sim/process/scratch_folder.hpp"

namespace sonoglide::long_work {

/// Of ten points in four shards.
inline Work small_work() {
  return {"sweep", "sonoglide 1", "lanes", "scene", "[plant]\n", {"a.b=1"}, {"c.d=1:2:10"}, 10, 4};
}

class ShardFolder {
 public:
  const std::filesystem::path& path() const { return scratch_.path(); }

  /// Publishes a shard whose records are the numbers of its points.
  void publish(std::uint64_t number, const Work& work = small_work()) const {
    const ShardHeader header{work, number};
    RowsWriter rows(path(), header, "test");
    const PointRange range = header.shard().range(work.points);
    for (std::uint64_t point = range.first; point < range.end; ++point) {
      rows.add(std::to_string(point));
    }
    rows.publish();
  }
  /// Whether no file is there, staged or published, whose name has a shard in it.
  bool has_no_shard() const {
    for (const auto& entry : std::filesystem::directory_iterator(path())) {
      if (entry.path().filename().string().find("shard") != std::string::npos) {
        return false;
      }
    }
    return true;
  }
  std::string read(const std::string& name) const {
    std::ifstream file(path() / name, std::ios::binary);
    return {std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>()};
  }
  void write(const std::string& name, const std::string& text) const {
    std::ofstream(path() / name, std::ios::binary) << text;
  }

 private:
  process::ScratchFolder scratch_{std::filesystem::temp_directory_path()};
};

}  // namespace sonoglide::long_work
