/// A curve of any length in bounded memory.
#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <vector>

namespace sonoglide::report {

/// Where a curve has a gap.
inline constexpr double gap = std::numeric_limits<double>::quiet_NaN();

/// Several ordinates over one rising abscissa. Complete up to `most_points` points; beyond, every
/// 2, 4, 8, … successive points are one piece, of which the smallest and the largest value of each
/// ordinate are kept: no excursion is lost, however short. NaN is passed over where a piece has
/// anything else.
template <std::size_t Ordinates>
class ExtremesCurve {
 public:
  using Values = std::array<double, Ordinates>;

  /// @param most_points  of the curve as it is drawn, even, >= 4
  explicit ExtremesCurve(std::size_t most_points) : most_points_(most_points) {}

  void add(double x, const Values& values) {
    if (pieces_.empty() || last_size_ == piece_size_) {
      open_piece(x);
    }
    Piece& piece = pieces_.back();
    if (last_size_ <= piece_size_ / 2) {
      piece.middle_x = x;
    }
    for (std::size_t i = 0; i < Ordinates; ++i) {
      piece.ranges[i].append({values[i], values[i], false});
    }
    ++last_size_;
  }

  /// Points that one piece stands for; 1 while the curve is complete.
  std::uint64_t piece_size() const { return piece_size_; }

  /// Complete: every point. Else two for each piece, at its first point and at its middle.
  std::vector<double> x() const {
    std::vector<double> points;
    for (const Piece& piece : pieces_) {
      points.push_back(piece.first_x);
      if (piece_size_ > 1) {
        points.push_back(piece.middle_x);
      }
    }
    return points;
  }

  /// The ordinate at each x(); of a piece its two extremes, in the order in which they came.
  std::vector<double> y(std::size_t ordinate) const {
    std::vector<double> points;
    for (const Piece& piece : pieces_) {
      const Range& range = piece.ranges[ordinate];
      points.push_back(range.falls ? range.highest : range.lowest);
      if (piece_size_ > 1) {
        points.push_back(range.falls ? range.lowest : range.highest);
      }
    }
    return points;
  }

 private:
  struct Range {
    double lowest = std::numeric_limits<double>::quiet_NaN();
    double highest = std::numeric_limits<double>::quiet_NaN();
    bool falls = false;  ///< the highest value came first

    void append(const Range& next) {
      const bool lower = !(lowest <= next.lowest) && !std::isnan(next.lowest);
      const bool higher = !(highest >= next.highest) && !std::isnan(next.highest);
      if (lower && higher) {
        falls = next.falls;
      } else if (lower || higher) {
        falls = lower;
      }
      lowest = lower ? next.lowest : lowest;
      highest = higher ? next.highest : highest;
    }
  };

  struct Piece {
    double first_x = 0.0;
    double middle_x = 0.0;
    std::array<Range, Ordinates> ranges;
  };

  std::size_t most_pieces() const { return piece_size_ == 1 ? most_points_ : most_points_ / 2; }

  void open_piece(double x) {
    while (pieces_.size() >= most_pieces()) {
      join_pairs();
    }
    if (pieces_.empty() || last_size_ == piece_size_) {
      pieces_.push_back({x, x, {}});
      last_size_ = 0;
    }
  }

  /// An odd piece at the end stays open.
  void join_pairs() {
    const std::size_t count = pieces_.size();
    for (std::size_t i = 0; i + 1 < count; i += 2) {
      Piece joined = pieces_[i];
      joined.middle_x = pieces_[i + 1].first_x;
      for (std::size_t k = 0; k < Ordinates; ++k) {
        joined.ranges[k].append(pieces_[i + 1].ranges[k]);
      }
      pieces_[i / 2] = joined;
    }
    if (count % 2 == 1) {
      pieces_[count / 2] = pieces_[count - 1];
    }
    pieces_.resize((count + 1) / 2);
    last_size_ = count % 2 == 1 ? piece_size_ : 2 * piece_size_;
    piece_size_ *= 2;
  }

  std::size_t most_points_;
  std::uint64_t piece_size_ = 1;
  std::uint64_t last_size_ = 0;  ///< points in the last piece
  std::vector<Piece> pieces_;
};

}  // namespace sonoglide::report
